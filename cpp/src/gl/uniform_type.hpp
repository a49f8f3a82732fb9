// GLSL's types of uniforms, as OpenGL numbers them.
#pragma once

#include <glad/gl.h>

namespace opacity::gl {

struct UniformType {
    GLenum type;
    const char* name;  // "vec3"
    int components;
    // Null for types that no list of floats can fill.
    void (*set_floats)(const GladGLContext& gl, GLuint program, GLint location, GLsizei count,
                       const GLfloat* values);
};

// For a type that is not in the table: one with a name that says so.
const UniformType& uniform_type(GLenum type);

bool is_sampler(GLenum type);
bool is_image(GLenum type);
bool is_bit_image(GLenum type);  // of unsigned whole numbers

}  // namespace opacity::gl
