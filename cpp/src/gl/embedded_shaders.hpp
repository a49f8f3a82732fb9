// The shaders under cpp/shaders, compiled in by
// cmake/EmbedShaders.cmake so that a wheel is self-contained.
#pragma once

#include <span>
#include <string_view>

namespace opacity::gl {

struct EmbeddedShader {
    std::string_view path, text;  // "lib/deposit.glsl"
};

std::span<const EmbeddedShader> embedded_shaders();

}  // namespace opacity::gl
