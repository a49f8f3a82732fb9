#include "gl/object.hpp"

#include "gl/check.hpp"

namespace opacity::gl {

GLuint create_name(Context& context, Kind kind, GLenum type) {
    const Context::Use use{context};
    const GladGLContext& gl = context.gl();
    GLuint name = 0;
    switch (kind) {
        case Kind::texture:
            gl.CreateTextures(type, 1, &name);
            break;
        case Kind::buffer:
            gl.CreateBuffers(1, &name);
            break;
        case Kind::framebuffer:
            gl.CreateFramebuffers(1, &name);
            break;
        case Kind::vertex_array:
            gl.CreateVertexArrays(1, &name);
            break;
        case Kind::program:
            name = gl.CreateProgram();
            break;
        case Kind::shader:
            name = gl.CreateShader(type);
            break;
        case Kind::sampler:
            gl.CreateSamplers(1, &name);
            break;
    }
    check_errors(context, "creating an object");
    return name;
}

void delete_name(const GladGLContext& gl, Kind kind, GLuint name) noexcept {
    switch (kind) {
        case Kind::texture:
            return gl.DeleteTextures(1, &name);
        case Kind::buffer:
            return gl.DeleteBuffers(1, &name);
        case Kind::framebuffer:
            return gl.DeleteFramebuffers(1, &name);
        case Kind::vertex_array:
            return gl.DeleteVertexArrays(1, &name);
        case Kind::program:
            return gl.DeleteProgram(name);
        case Kind::shader:
            return gl.DeleteShader(name);
        case Kind::sampler:
            return gl.DeleteSamplers(1, &name);
    }
}

}  // namespace opacity::gl
