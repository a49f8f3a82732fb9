// What passes write: textures and buffers. The graph owns their names and revisions, a Device their
// storage.
#pragma once

#include <cstddef>
#include <string>
#include <utility>

#include "opacity/core/math.hpp"
#include "opacity/core/source.hpp"

namespace opacity {

// What is written to and read from memory has four bytes a channel whatever the format: of rgba16f
// and rgba8 floats.
enum class Format { depth32f, r32f, rgba32f, rgba16f, rgba8, r32ui, rgba32ui };

int channels(Format format);

class Resource : public Source {
   public:
    explicit Resource(std::string name) : Source{std::move(name)} {}
    void feed(Feeder& feeder) const override { feeder.resource(*this); }
};

struct TextureDesc {
    Format format = Format::rgba32f;
    int width = 1, height = 1;
    int layers = 0;  // 0: a plain 2D texture; otherwise an array
    // Drawn at n x n samples a texel; colours are averaged at the end of the pass, depths stay as
    // they are.
    int oversampling = 1;
    bool operator==(const TextureDesc&) const = default;
};

// Texels of its content along a texel of the description: depths have no mean, and stay
// oversampled.
inline int content_scale(const TextureDesc& desc) {
    return desc.format == Format::depth32f ? desc.oversampling : 1;
}

// What its content takes on a GPU, where rgba16f and rgba8 are as small as they say; not the
// samples of oversampled colours, which a pass drops at its end.
std::size_t stored_bytes(const TextureDesc& desc);

class Texture : public Resource {
   public:
    Texture(std::string name, const TextureDesc& desc) : Resource{std::move(name)}, desc_{desc} {}
    const TextureDesc& desc() const noexcept { return desc_; }
    void describe(const TextureDesc& desc) {
        if (desc == desc_) return;
        desc_ = desc;
        touch();
    }

   private:
    TextureDesc desc_;
};

class Buffer : public Resource {
   public:
    using Resource::Resource;
    std::size_t size_bytes() const noexcept { return size_bytes_; }
    void resize(std::size_t size_bytes) { size_bytes_ = size_bytes; }

   private:
    std::size_t size_bytes_ = 0;
};

}  // namespace opacity
