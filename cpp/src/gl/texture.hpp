// A texture with immutable storage; another size is another Texture.
#pragma once

#include <cstddef>
#include <memory>
#include <span>

#include "gl/object.hpp"

namespace opacity::gl {

// How one texel of an internal format crosses to and from the CPU. Formats with
// fewer bits than a float cross as floats, except 8-bit ones, which cross as bytes.
struct TexelFormat {
    GLenum internal, layout, type;
    std::size_t size_bytes;  // on the CPU
    const char* name;        // "RGBA32F"
};

// ParameterError for a format that the library does not use.
const TexelFormat& texel_format(GLenum internal_format);

class Texture {
   public:
    Texture() = default;
    // `target` is GL_TEXTURE_2D, GL_TEXTURE_2D_ARRAY or GL_TEXTURE_3D (its depth
    // is `layers`). The content is undefined; filtering starts as nearest, clamped
    // to the edge. Each of the `levels` halves the one before, down to 1; only a 2-D
    // texture has more than one. ParameterError beyond the driver's limits, OutOfMemoryError.
    Texture(std::shared_ptr<Context> context, GLenum target, GLenum internal_format, int width,
            int height, int layers = 1, int levels = 1);

    GLuint name() const noexcept { return object_.name(); }
    GLenum target() const noexcept { return target_; }
    GLenum internal_format() const noexcept { return internal_format_; }
    int width() const noexcept { return width_; }
    int height() const noexcept { return height_; }
    int layers() const noexcept { return layers_; }
    // Of a level's content as it crosses to the CPU: rows from
    // the bottom, layer after layer, without padding.
    std::size_t size_bytes(int level = 0) const;

    // Exactly size_bytes(level), or size_bytes().
    void write(std::span<const std::byte> texels, int level = 0);
    void read(std::span<std::byte> texels) const;
    // GL_NEAREST or GL_LINEAR, the latter between levels too; GL_CLAMP_TO_EDGE or GL_REPEAT.
    void set_filter(GLenum filter);
    void set_wrap(GLenum wrap);
    // All texels zero.
    void clear();
    // Of floats: every channel.
    void fill(float value);

   private:
    TextureObject object_;
    GLenum target_ = 0, internal_format_ = 0;
    int width_ = 0, height_ = 0, layers_ = 0, levels_ = 0;
};

}  // namespace opacity::gl
