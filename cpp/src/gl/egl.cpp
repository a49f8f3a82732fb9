#include "gl/egl.hpp"

#include "gl/library.hpp"

namespace opacity::gl {
namespace {

constexpr std::string_view packages =
    "install libegl1 and libgl1-mesa-dri (their Debian and Ubuntu names), or your GPU's driver "
    "with its EGL; "
    "OPACITY_LIBEGL can name a library that is elsewhere";

}  // namespace

Egl Egl::open() {
    const Library library{"OPACITY_LIBEGL", {"libEGL.so.1"}, packages};
    Egl egl;
    library.find(egl.GetProcAddress, "eglGetProcAddress");
    library.find(egl.GetError, "eglGetError");
    library.find(egl.QueryString, "eglQueryString");
    library.find(egl.Initialize, "eglInitialize");
    library.find(egl.BindAPI, "eglBindAPI");
    library.find(egl.QueryAPI, "eglQueryAPI");
    library.find(egl.ChooseConfig, "eglChooseConfig");
    library.find(egl.CreateContext, "eglCreateContext");
    library.find(egl.DestroyContext, "eglDestroyContext");
    library.find(egl.MakeCurrent, "eglMakeCurrent");
    library.find(egl.GetCurrentContext, "eglGetCurrentContext");
    library.find(egl.GetCurrentDisplay, "eglGetCurrentDisplay");
    library.find(egl.GetCurrentSurface, "eglGetCurrentSurface");
    const auto find_extension = [&]<class Function>(Function*& function, const char* name) {
        function = reinterpret_cast<Function*>(egl.GetProcAddress(name));
    };
    find_extension(egl.GetPlatformDisplay, "eglGetPlatformDisplayEXT");
    find_extension(egl.QueryDevices, "eglQueryDevicesEXT");
    find_extension(egl.QueryDeviceString, "eglQueryDeviceStringEXT");
    return egl;
}

std::string Egl::last_error() const {
    switch (const EGLint error = GetError()) {
        case EGL_SUCCESS:
            return "no reason given";
        case EGL_NOT_INITIALIZED:
            return "EGL_NOT_INITIALIZED (no driver for it, or no access)";
        case EGL_BAD_ACCESS:
            return "EGL_BAD_ACCESS";
        case EGL_BAD_ALLOC:
            return "EGL_BAD_ALLOC";
        case EGL_BAD_ATTRIBUTE:
            return "EGL_BAD_ATTRIBUTE";
        case EGL_BAD_CONFIG:
            return "EGL_BAD_CONFIG";
        case EGL_BAD_CONTEXT:
            return "EGL_BAD_CONTEXT";
        case EGL_BAD_DISPLAY:
            return "EGL_BAD_DISPLAY";
        case EGL_BAD_MATCH:
            return "EGL_BAD_MATCH";
        case EGL_BAD_PARAMETER:
            return "EGL_BAD_PARAMETER";
        case EGL_CONTEXT_LOST:
            return "EGL_CONTEXT_LOST";
        default:
            return "EGL error " + std::to_string(error);
    }
}

bool has_extension(const char* list, std::string_view extension) {
    // Whole words: EGL_EXT_device_base is also the beginning of longer names.
    const std::string words = " " + std::string{list ? list : ""} + " ";
    return words.find(" " + std::string{extension} + " ") != std::string::npos;
}

EglBinding::EglBinding(const Egl& egl)
    : display_{egl.GetCurrentDisplay()},
      draw_{egl.GetCurrentSurface(EGL_DRAW)},
      read_{egl.GetCurrentSurface(EGL_READ)},
      context_{egl.GetCurrentContext()} {}

bool EglBinding::make_current(const Egl& egl, EGLDisplay display_if_none) const noexcept {
    const EGLDisplay display = context_ ? display_ : display_if_none;
    return egl.MakeCurrent(display, draw_, read_, context_) == EGL_TRUE;
}

}  // namespace opacity::gl
