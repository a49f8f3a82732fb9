// What the tests of OpenGL share: a context, or a message that says why the test was skipped.
#pragma once

#include <doctest/doctest.h>
#include <glad/gl.h>

#include <memory>
#include <span>
#include <string>

#include "gl/object.hpp"
#include "gl/texture.hpp"
#include "opacity/core/error.hpp"
#include "opacity/gl/context.hpp"

inline std::shared_ptr<opacity::gl::Context> context_or_skip() {
    try {
        return opacity::gl::Context::headless();
    } catch (const opacity::ContextError& error) {
        MESSAGE("skipped, no OpenGL here: ", std::string{error.what()});
        return nullptr;
    }
}

inline GLint get(const GladGLContext& gl, GLenum name) {
    GLint value = 0;
    gl.GetIntegerv(name, &value);
    return value;
}

inline GLint get(const GladGLContext& gl, GLenum name, GLuint index) {
    GLint value = 0;
    gl.GetIntegeri_v(name, index, &value);
    return value;
}

// Clears a framebuffer to a value and reads it back: the context really renders.
inline float render_one_texel(const std::shared_ptr<opacity::gl::Context>& context, float value) {
    const opacity::gl::Context::Use use{*context};
    const GladGLContext& gl = context->gl();
    opacity::gl::Texture texture{context, GL_TEXTURE_2D, GL_R32F, 1, 1};
    opacity::gl::Framebuffer framebuffer{context};
    gl.NamedFramebufferTexture(framebuffer.name(), GL_COLOR_ATTACHMENT0, texture.name(), 0);
    gl.ClearNamedFramebufferfv(framebuffer.name(), GL_COLOR, 0, &value);
    float found = -1.f;
    texture.read(std::as_writable_bytes(std::span{&found, 1}));
    return found;
}
