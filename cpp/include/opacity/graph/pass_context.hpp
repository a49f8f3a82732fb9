// What an executing pass may do.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "opacity/graph/device.hpp"
#include "opacity/graph/pass.hpp"

namespace opacity {

class FrameGraph;

// Anything that the pass did not declare is an error that names the line to add.
class PassContext {
   public:
    PassContext(FrameGraph& graph, const Pass& pass) : graph_{graph}, pass_{pass} {}

    // With `extra` uniforms besides those of the reads.
    void draw(const Uniforms& extra = {}, const ShapeFilter& wanted = {});
    // At least `count` invocations of a shader that includes lib/invocation.glsl.
    void dispatch(int count, const Uniforms& extra = {});
    // The pass's compute stage for each strand's segment, or particle, of its shapes:
    // lib/scatter.glsl.
    void dispatch_shapes(const ShapeFilter& wanted = {});
    // A declared store gets a new size before it is written.
    void resize(Texture& texture, const TextureDesc& desc);
    void resize(Buffer& buffer, std::size_t size_bytes);
    void write(const Resource& resource, std::span<const std::byte> content);
    void zero(const Texture& texture);
    void fill(const Texture& texture, float value);

    // The content of a declared read.
    template <class T>
    std::vector<T> read(const Texture& texture) {
        std::vector<T> content(size_bytes(texture.desc()) / sizeof(T));
        read_bytes(texture, std::as_writable_bytes(std::span{content}));
        return content;
    }
    template <class T>
    std::vector<T> read(const Buffer& buffer) {
        std::vector<T> content(buffer.size_bytes() / sizeof(T));
        read_bytes(buffer, std::as_writable_bytes(std::span{content}));
        return content;
    }
    // Where a pass in C++ reads and writes: a declared read, store or target.
    template <class T>
    std::span<T> memory(const Resource& resource) {
        const std::span<std::byte> bytes = memory_bytes(resource);
        return {reinterpret_cast<T*>(bytes.data()), bytes.size() / sizeof(T)};
    }
    // Sets a declared value; everything that reads it stays cached if it did not change.
    template <class T>
    void set(Value<T>& value, T content) {
        require_value(value);
        value.set(std::move(content));
    }

    // Shown in the report beside the pass.
    void note(std::string text) { note_ = std::move(text); }

   private:
    friend class FrameGraph;
    void note_hidden_chunks();
    void read_bytes(const Resource& resource, std::span<std::byte> content);
    std::span<std::byte> memory_bytes(const Resource& resource);
    void require_value(const Source& value) const;
    void require_store(const Resource& resource) const;

    FrameGraph& graph_;
    const Pass& pass_;
    std::string note_;
};

}  // namespace opacity
