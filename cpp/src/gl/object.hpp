// The name of an OpenGL object and the duty to delete it. Move-only.
// It may die on any thread and after the last Renderer: the Context
// that it holds deletes the name when and where that is possible.
#pragma once

#include <glad/gl.h>

#include <memory>
#include <utility>

#include "opacity/gl/context.hpp"

namespace opacity::gl {

enum class Kind { texture, buffer, framebuffer, vertex_array, program, shader, sampler };

// `type` is the target of a texture and the stage of a shader; the other kinds have none.
GLuint create_name(Context& context, Kind kind, GLenum type);
void delete_name(const GladGLContext& gl, Kind kind, GLuint name) noexcept;

template <Kind kind>
class Object {
   public:
    Object() = default;
    explicit Object(std::shared_ptr<Context> context, GLenum type = 0)
        : context_{std::move(context)}, name_{create_name(*context_, kind, type)} {
        context_->count_object(+1);
    }
    Object(Object&& other) noexcept
        : context_{std::move(other.context_)}, name_{std::exchange(other.name_, 0)} {}
    Object& operator=(Object&& other) noexcept {
        std::swap(context_, other.context_);
        std::swap(name_, other.name_);
        return *this;
    }
    ~Object() {
        if (!name_ || !context_) return;  // the second for the compiler: a name has a context
        context_->count_object(-1);
        context_->release(int(kind), name_);
    }

    GLuint name() const noexcept { return name_; }
    explicit operator bool() const noexcept { return name_ != 0; }
    // Null for an Object without a name.
    const std::shared_ptr<Context>& context() const noexcept { return context_; }

   private:
    std::shared_ptr<Context> context_;
    GLuint name_ = 0;
};

using TextureObject = Object<Kind::texture>;
using BufferObject = Object<Kind::buffer>;
using Framebuffer = Object<Kind::framebuffer>;
using VertexArray = Object<Kind::vertex_array>;
using ProgramObject = Object<Kind::program>;
using ShaderObject = Object<Kind::shader>;
using Sampler = Object<Kind::sampler>;

}  // namespace opacity::gl
