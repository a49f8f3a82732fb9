// libEGL, opened at run time: a program that links it would not start where there is none.
#pragma once

#include <glad/egl.h>

#include <string>
#include <string_view>

namespace opacity::gl {

struct Egl {
    // OPACITY_LIBEGL may name another library. ContextError says what was missing.
    static Egl open();

    PFNEGLGETPROCADDRESSPROC GetProcAddress = nullptr;
    PFNEGLGETERRORPROC GetError = nullptr;
    PFNEGLQUERYSTRINGPROC QueryString = nullptr;
    PFNEGLINITIALIZEPROC Initialize = nullptr;
    PFNEGLBINDAPIPROC BindAPI = nullptr;
    PFNEGLQUERYAPIPROC QueryAPI = nullptr;
    PFNEGLCHOOSECONFIGPROC ChooseConfig = nullptr;
    PFNEGLCREATECONTEXTPROC CreateContext = nullptr;
    PFNEGLDESTROYCONTEXTPROC DestroyContext = nullptr;
    PFNEGLMAKECURRENTPROC MakeCurrent = nullptr;
    PFNEGLGETCURRENTCONTEXTPROC GetCurrentContext = nullptr;
    PFNEGLGETCURRENTDISPLAYPROC GetCurrentDisplay = nullptr;
    PFNEGLGETCURRENTSURFACEPROC GetCurrentSurface = nullptr;
    // Extensions: null where the library does not have them.
    PFNEGLGETPLATFORMDISPLAYEXTPROC GetPlatformDisplay = nullptr;
    PFNEGLQUERYDEVICESEXTPROC QueryDevices = nullptr;
    PFNEGLQUERYDEVICESTRINGEXTPROC QueryDeviceString = nullptr;

    // "EGL_NOT_INITIALIZED" for the error of the last call.
    std::string last_error() const;
};

// Whether a space-separated list of extensions holds this one; the list may be null.
bool has_extension(const char* list, std::string_view extension);

// What EGL has current on this thread, to be made current again.
class EglBinding {
   public:
    explicit EglBinding(const Egl& egl);
    EGLContext context() const noexcept { return context_; }
    // Where nothing was current, a display is still needed to say so.
    bool make_current(const Egl& egl, EGLDisplay display_if_none) const noexcept;

   private:
    EGLDisplay display_;
    EGLSurface draw_, read_;
    EGLContext context_;
};

}  // namespace opacity::gl
