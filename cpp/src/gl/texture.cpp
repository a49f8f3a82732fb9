#include "gl/texture.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <string>

#include "gl/check.hpp"
#include "opacity/core/error.hpp"

namespace opacity::gl {
namespace {

constexpr std::array<TexelFormat, 14> formats = {{
    {GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT, GL_FLOAT, 4, "DEPTH32F"},
    {GL_R32F, GL_RED, GL_FLOAT, 4, "R32F"},
    {GL_RG32F, GL_RG, GL_FLOAT, 8, "RG32F"},
    {GL_RGBA32F, GL_RGBA, GL_FLOAT, 16, "RGBA32F"},
    {GL_R16F, GL_RED, GL_FLOAT, 4, "R16F"},
    {GL_RG16F, GL_RG, GL_FLOAT, 8, "RG16F"},
    {GL_RGBA16F, GL_RGBA, GL_FLOAT, 16, "RGBA16F"},
    {GL_R16, GL_RED, GL_FLOAT, 4, "R16"},
    {GL_RGBA16, GL_RGBA, GL_FLOAT, 16, "RGBA16"},
    {GL_R8, GL_RED, GL_UNSIGNED_BYTE, 1, "R8"},
    {GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE, 4, "RGBA8"},
    {GL_SRGB8_ALPHA8, GL_RGBA, GL_UNSIGNED_BYTE, 4, "SRGB8_ALPHA8"},
    {GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, 4, "R32UI"},
    {GL_RGBA32UI, GL_RGBA_INTEGER, GL_UNSIGNED_INT, 16, "RGBA32UI"},
}};

std::string size_in_texels(int width, int height, int layers) {
    return std::to_string(width) + " x " + std::to_string(height) +
           (layers > 1 ? " x " + std::to_string(layers) : "");
}

int limit(const GladGLContext& gl, GLenum name) {
    GLint value = 0;
    gl.GetIntegerv(name, &value);
    return value;
}

void check_limits(const Context& context, GLenum target, int width, int height, int layers) {
    const bool volume = target == GL_TEXTURE_3D;
    const int max_side = limit(context.gl(), volume ? GL_MAX_3D_TEXTURE_SIZE : GL_MAX_TEXTURE_SIZE);
    const int max_layers = volume ? max_side
                           : target == GL_TEXTURE_2D_ARRAY
                               ? limit(context.gl(), GL_MAX_ARRAY_TEXTURE_LAYERS)
                               : 1;
    const bool fits = std::min({width, height, layers}) >= 1 &&
                      std::max(width, height) <= max_side && layers <= max_layers;
    if (fits) return;
    throw ParameterError("a texture of " + size_in_texels(width, height, layers) +
                             " texels is outside what " + context.renderer() + " takes",
                         "choose 1.." + std::to_string(max_side) + " texels for a side and 1.." +
                             std::to_string(max_layers) + " layers");
}

}  // namespace

const TexelFormat& texel_format(GLenum internal_format) {
    const auto found = std::find_if(formats.begin(), formats.end(), [&](const TexelFormat& format) {
        return format.internal == internal_format;
    });
    if (found != formats.end()) return *found;
    throw ParameterError(
        "no texel format for OpenGL's internal format " + std::to_string(internal_format),
        "use one of the table in gl/texture.cpp, or add a row to it");
}

Texture::Texture(std::shared_ptr<Context> context, GLenum target, GLenum internal_format, int width,
                 int height, int layers, int levels)
    : target_{target},
      internal_format_{internal_format},
      width_{width},
      height_{height},
      layers_{layers},
      levels_{levels} {
    assert(levels == 1 || target == GL_TEXTURE_2D);
    assert(target == GL_TEXTURE_2D || target == GL_TEXTURE_2D_ARRAY || target == GL_TEXTURE_3D);
    const Context::Use use{*context};
    const TexelFormat& format = texel_format(internal_format);
    check_limits(*context, target, width, height, layers);
    const std::string doing = "allocating a texture of " + size_in_texels(width, height, layers) +
                              " " + format.name + " texels (" + size_text(size_bytes()) + ")";
    check_fits(*context, size_bytes(), doing);
    object_ = TextureObject{context, target};
    const GladGLContext& gl = context->gl();
    if (target == GL_TEXTURE_2D) {
        gl.TextureStorage2D(name(), levels, internal_format, width, height);
    } else {
        gl.TextureStorage3D(name(), 1, internal_format, width, height, layers);
    }
    check_errors(*context, doing);
    set_filter(GL_NEAREST);
    set_wrap(GL_CLAMP_TO_EDGE);
}

std::size_t Texture::size_bytes(int level) const {
    const auto side = [level](int size) { return std::size_t(std::max(1, size >> level)); };
    return texel_format(internal_format_).size_bytes * side(width_) * side(height_) *
           std::size_t(layers_);
}

void Texture::write(std::span<const std::byte> texels, int level) {
    assert(level < levels_ && texels.size() == size_bytes(level));
    const Context::Use use{*object_.context()};
    const GladGLContext& gl = object_.context()->gl();
    const TexelFormat& format = texel_format(internal_format_);
    if (target_ == GL_TEXTURE_2D) {
        gl.TextureSubImage2D(name(), level, 0, 0, std::max(1, width_ >> level),
                             std::max(1, height_ >> level), format.layout, format.type,
                             texels.data());
    } else {
        gl.TextureSubImage3D(name(), 0, 0, 0, 0, width_, height_, layers_, format.layout,
                             format.type, texels.data());
    }
    check_errors(*object_.context(), "writing a texture of " + size_text(size_bytes()));
}

void Texture::read(std::span<std::byte> texels) const {
    assert(texels.size() == size_bytes());
    const Context::Use use{*object_.context()};
    const GladGLContext& gl = object_.context()->gl();
    const TexelFormat& format = texel_format(internal_format_);
    // In blocks of rows: the driver's own size argument is an int, which ends at 2 GiB.
    const std::size_t row_bytes = format.size_bytes * std::size_t(width_);
    const int block_rows = std::min<int>(height_, int((std::size_t{1} << 30) / row_bytes));
    std::byte* to = texels.data();
    for (int layer = 0; layer < layers_; ++layer) {
        for (int row = 0; row < height_; row += block_rows) {
            const int rows = std::min(block_rows, height_ - row);
            const std::size_t bytes = row_bytes * std::size_t(rows);
            gl.GetTextureSubImage(name(), 0, 0, row, layer, width_, rows, 1, format.layout,
                                  format.type, GLsizei(bytes), to);
            to += bytes;
        }
    }
    check_errors(*object_.context(), "reading a texture of " + size_text(size_bytes()));
}

void Texture::set_filter(GLenum filter) {
    const Context::Use use{*object_.context()};
    const GladGLContext& gl = object_.context()->gl();
    const bool between_levels = levels_ > 1 && filter == GL_LINEAR;
    gl.TextureParameteri(name(), GL_TEXTURE_MIN_FILTER,
                         between_levels ? GL_LINEAR_MIPMAP_LINEAR : GLint(filter));
    gl.TextureParameteri(name(), GL_TEXTURE_MAG_FILTER, GLint(filter));
}

void Texture::set_wrap(GLenum wrap) {
    const Context::Use use{*object_.context()};
    for (const GLenum axis : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R})
        object_.context()->gl().TextureParameteri(name(), axis, GLint(wrap));
}

void Texture::fill(float value) {
    const Context::Use use{*object_.context()};
    const TexelFormat& format = texel_format(internal_format_);
    const std::array<float, 4> texel{value, value, value, value};
    object_.context()->gl().ClearTexImage(name(), 0, format.layout, format.type, texel.data());
    check_errors(*object_.context(), "filling a texture of " + size_text(size_bytes()));
}

void Texture::clear() {
    const Context::Use use{*object_.context()};
    const TexelFormat& format = texel_format(internal_format_);
    object_.context()->gl().ClearTexImage(name(), 0, format.layout, format.type, nullptr);
    check_errors(*object_.context(), "clearing a texture of " + size_text(size_bytes()));
}

}  // namespace opacity::gl
