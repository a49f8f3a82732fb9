#include "gl/uniform_type.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace opacity::gl {
namespace {

using Gl = const GladGLContext&;

constexpr std::array<UniformType, 16> types = {{
    {GL_FLOAT, "float", 1,
     [](Gl gl, GLuint p, GLint l, GLsizei n, const float* v) { gl.ProgramUniform1fv(p, l, n, v); }},
    {GL_FLOAT_VEC2, "vec2", 2,
     [](Gl gl, GLuint p, GLint l, GLsizei n, const float* v) { gl.ProgramUniform2fv(p, l, n, v); }},
    {GL_FLOAT_VEC3, "vec3", 3,
     [](Gl gl, GLuint p, GLint l, GLsizei n, const float* v) { gl.ProgramUniform3fv(p, l, n, v); }},
    {GL_FLOAT_VEC4, "vec4", 4,
     [](Gl gl, GLuint p, GLint l, GLsizei n, const float* v) { gl.ProgramUniform4fv(p, l, n, v); }},
    {GL_FLOAT_MAT3, "mat3", 9,
     [](Gl gl, GLuint p, GLint l, GLsizei n, const float* v) {
         gl.ProgramUniformMatrix3fv(p, l, n, GL_FALSE, v);
     }},
    {GL_FLOAT_MAT4, "mat4", 16,
     [](Gl gl, GLuint p, GLint l, GLsizei n, const float* v) {
         gl.ProgramUniformMatrix4fv(p, l, n, GL_FALSE, v);
     }},
    {GL_INT, "int", 1, nullptr},
    {GL_INT_VEC2, "ivec2", 2, nullptr},
    {GL_INT_VEC3, "ivec3", 3, nullptr},
    {GL_INT_VEC4, "ivec4", 4, nullptr},
    {GL_UNSIGNED_INT, "uint", 1, nullptr},
    {GL_UNSIGNED_INT_VEC2, "uvec2", 2, nullptr},
    {GL_UNSIGNED_INT_VEC3, "uvec3", 3, nullptr},
    {GL_UNSIGNED_INT_VEC4, "uvec4", 4, nullptr},
    {GL_BOOL, "bool", 1, nullptr},
    {GL_DOUBLE, "double", 1, nullptr},
}};
constexpr UniformType unsupported = {0, "(a type that this library cannot feed)", 0, nullptr};

bool within(GLenum type, GLenum first, GLenum last) {
    return first <= type && type <= last;
}

}  // namespace

const UniformType& uniform_type(GLenum type) {
    const auto found = std::find_if(types.begin(), types.end(),
                                    [&](const UniformType& t) { return t.type == type; });
    return found == types.end() ? unsupported : *found;
}

// OpenGL numbers them in runs, one for each extension that once added them.
bool is_sampler(GLenum type) {
    return within(type, GL_SAMPLER_1D, GL_SAMPLER_2D_RECT_SHADOW) ||
           within(type, GL_SAMPLER_1D_ARRAY, GL_SAMPLER_CUBE_SHADOW) ||
           within(type, GL_INT_SAMPLER_1D, GL_UNSIGNED_INT_SAMPLER_BUFFER) ||
           within(type, GL_SAMPLER_CUBE_MAP_ARRAY, GL_UNSIGNED_INT_SAMPLER_CUBE_MAP_ARRAY) ||
           within(type, GL_SAMPLER_2D_MULTISAMPLE, GL_UNSIGNED_INT_SAMPLER_2D_MULTISAMPLE_ARRAY);
}

bool is_bit_image(GLenum type) {
    return within(type, GL_UNSIGNED_INT_IMAGE_1D, GL_UNSIGNED_INT_IMAGE_2D_MULTISAMPLE_ARRAY);
}

bool is_image(GLenum type) {
    return within(type, GL_IMAGE_1D, GL_UNSIGNED_INT_IMAGE_2D_MULTISAMPLE_ARRAY);
}

}  // namespace opacity::gl
