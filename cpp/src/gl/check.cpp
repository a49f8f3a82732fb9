#include "gl/check.hpp"

#include <glad/gl.h>

#include <cstdio>

#include "opacity/core/error.hpp"

namespace opacity::gl {
namespace {

constexpr GLenum gpu_memory_dedicated_nvx = 0x9047;  // in KiB; GL_NVX_gpu_memory_info
constexpr std::size_t smallest_suspect = std::size_t{1} << 30;

const char* error_name(GLenum error) {
    switch (error) {
        case GL_INVALID_ENUM:
            return "GL_INVALID_ENUM";
        case GL_INVALID_VALUE:
            return "GL_INVALID_VALUE";
        case GL_INVALID_OPERATION:
            return "GL_INVALID_OPERATION";
        case GL_INVALID_FRAMEBUFFER_OPERATION:
            return "GL_INVALID_FRAMEBUFFER_OPERATION";
        case GL_STACK_OVERFLOW:
            return "GL_STACK_OVERFLOW";
        case GL_STACK_UNDERFLOW:
            return "GL_STACK_UNDERFLOW";
        default:
            return "an unknown error";
    }
}

OutOfMemoryError out_of_memory(std::string_view doing) {
    return OutOfMemoryError(
        "OpenGL ran out of memory while " + std::string{doing},
        "ask for less: a smaller map_size or size, fewer layers, or fewer shapes");
}

bool has_extension(const GladGLContext& gl, std::string_view name) {
    GLint count = 0;
    gl.GetIntegerv(GL_NUM_EXTENSIONS, &count);
    for (GLint i = 0; i < count; ++i)
        if (name == reinterpret_cast<const char*>(gl.GetStringi(GL_EXTENSIONS, GLuint(i))))
            return true;
    return false;
}

}  // namespace

void check_fits(const Context& context, std::size_t bytes, std::string_view doing) {
    if (bytes < smallest_suspect || !has_extension(context.gl(), "GL_NVX_gpu_memory_info")) return;
    GLint device_kib = 0;
    context.gl().GetIntegerv(gpu_memory_dedicated_nvx, &device_kib);
    if (bytes / 1024 > std::size_t(device_kib)) throw out_of_memory(doing);
}

void check_errors(const Context& context, std::string_view doing) {
    GLenum first = GL_NO_ERROR;
    // Each kind of error has a flag of its own: all are cleared, the first is told.
    while (const GLenum error = context.gl().GetError()) {
        if (error == GL_CONTEXT_LOST) {
            throw DeviceLostError(
                "the driver reset the device while " + std::string{doing},
                "create a new Context and Renderer; a smaller map_size or size shortens each "
                "draw call, if the driver thought that one hung");
        }
        if (first == GL_NO_ERROR) first = error;
    }
    if (first == GL_NO_ERROR) return;
    if (first == GL_OUT_OF_MEMORY) throw out_of_memory(doing);
    throw Error(std::string{error_name(first)} + " while " + std::string{doing} + " on " +
                    context.renderer(),
                "this is a bug in the library: report it with this message; OPACITY_GL_DEBUG=1 "
                "makes the driver say more");
}

std::string size_text(std::size_t bytes) {
    const char* const units[] = {"bytes", "KiB", "MiB", "GiB", "TiB", "PiB", "EiB"};
    double size = double(bytes);
    std::size_t unit = 0;
    for (; size >= 1024.0; ++unit) size /= 1024.0;
    char text[32];
    std::snprintf(text, sizeof text, unit ? "%.1f %s" : "%.0f %s", size, units[unit]);
    return text;
}

}  // namespace opacity::gl
