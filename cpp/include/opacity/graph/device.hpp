// What the graph asks of whoever executes passes. The OpenGL one is in src/render; tests bring
// their own.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "opacity/graph/pass.hpp"

namespace opacity {

class Device {
   public:
    virtual ~Device() = default;

    // Whether it draws and dispatches; if not, it keeps all resources in memory, and passes with a
    // shader run their form in C++.
    virtual bool runs_shaders() const { return true; }
    virtual std::span<std::byte> memory(const Resource&) { return {}; }
    // Forgets copies of shapes that no scene holds any more.
    virtual void collect() {}

    // Moves when the text of a shader on disk does.
    virtual Revision shader_revision() = 0;
    // Storage for the resource as it is described now; the content is undefined.
    virtual void allocate(const Resource& resource) = 0;
    virtual void release(const Resource& resource) noexcept = 0;

    // Clears the pass's targets; then draws, once for each shape of its list that is wanted.
    virtual void clear(const Pass& pass) = 0;
    virtual void draw(const Pass& pass, const Uniforms& extra, const ShapeFilter& wanted) = 0;
    virtual void dispatch(const Pass& pass, std::array<int, 3> groups, const Uniforms& extra) = 0;
    // The compute stage over the casters of each shape that is wanted, and the faces of the view.
    virtual void dispatch_shapes(const Pass& pass, const ShapeFilter& wanted) = 0;

    virtual void zero(const Resource& resource) = 0;
    // The same value in every channel of a texture of floats.
    virtual void fill(const Texture& texture, float value) = 0;
    virtual void write(const Resource& resource, std::span<const std::byte> content) = 0;
    virtual void read(const Resource& resource, std::span<std::byte> content) = 0;
    virtual void finish() = 0;
    // Draw calls and dispatches so far.
    virtual std::size_t calls() const { return 0; }
};

// Groups for at least so many invocations of a shader that includes lib/invocation.glsl.
std::array<int, 3> work_groups(int count);

// Bytes of a texture's content at one sample a texel.
std::size_t size_bytes(const TextureDesc& desc);

}  // namespace opacity
