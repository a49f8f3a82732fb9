// Headless contexts: which EGL displays there are, in which
// order they are tried, and a context on one of them.
#include <cstdlib>
#include <optional>

#include "gl/egl.hpp"
#include "gl/process.hpp"
#include "opacity/core/error.hpp"
#include "opacity/gl/context.hpp"

namespace opacity::gl {
namespace {

constexpr const char* fix =
    "install libegl1 and libgl1-mesa-dri (their Debian and Ubuntu names: software rendering and "
    "open drivers), or "
    "the GPU's own driver with EGL; OpenGL 4.5 is needed";

class EglContext : public Context {
   public:
    EglContext(const Egl& egl, EGLDisplay display, EGLContext context, Logger logger,
               std::vector<std::string> search)
        : Context{std::move(logger), false}, egl_{egl}, display_{display}, context_{context} {
        search_ = std::move(search);
    }

    ~EglContext() override {
        if (forked()) return;
        // Deleting a current context only marks it. The display stays: other contexts may
        // live on it, ours or the application's, and eglTerminate would end them all.
        if (egl_.GetCurrentContext() == context_) release_current();
        egl_.DestroyContext(display_, context_);
    }

    void start() { load(egl_.GetProcAddress); }

   private:
    void make_current() override {
        const EglBinding previous{egl_};
        if (previous.context() != context_ &&
            !egl_.MakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_)) {
            throw ContextError("the OpenGL context could not be made current: " + egl_.last_error(),
                               "if this thread has a context that EGL did not make (GLX), release "
                               "it first, or give "
                               "it to Context::adopt");
        }
        previous_.push_back(previous);
    }

    void make_previous_current() noexcept override {
        const EglBinding previous = previous_.back();
        previous_.pop_back();
        if (previous.context() == context_) return;
        // A context that has died meanwhile cannot come
        // back; ours must not stay current in its place.
        if (!previous.make_current(egl_, display_)) release_current();
    }

    void release_current() noexcept {
        egl_.MakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    }

    Egl egl_;
    EGLDisplay display_;
    EGLContext context_;
    std::vector<EglBinding> previous_;  // one for each Use that has begun
};

// eglBindAPI is a setting of the thread, which belongs to the application.
class BoundApi {
   public:
    BoundApi(const Egl& egl, EGLenum api) : egl_{egl}, previous_{egl.QueryAPI()} {
        bound_ = egl.BindAPI(api) == EGL_TRUE;
    }
    ~BoundApi() { egl_.BindAPI(previous_); }
    BoundApi(const BoundApi&) = delete;
    BoundApi& operator=(const BoundApi&) = delete;
    explicit operator bool() const { return bound_; }

   private:
    const Egl& egl_;
    EGLenum previous_;
    bool bound_;
};

struct Candidate {
    std::string description;
    EGLenum platform;
    void* native;  // the EGLDeviceEXT of the device platform
    bool software;
};

std::vector<Candidate> devices(const Egl& egl) {
    if (!egl.QueryDevices || !egl.QueryDeviceString) return {};
    EGLint count = 0;
    if (!egl.QueryDevices(0, nullptr, &count) || count <= 0) return {};
    std::vector<EGLDeviceEXT> handles(count);
    if (!egl.QueryDevices(count, handles.data(), &count)) return {};
    std::vector<Candidate> found;
    for (EGLint i = 0; i < count; ++i) {
        const char* extensions = egl.QueryDeviceString(handles[i], EGL_EXTENSIONS);
        const bool software = has_extension(extensions, "EGL_MESA_device_software");
        std::string description = "EGL device " + std::to_string(i);
        if (software) description += " (software)";
        if (has_extension(extensions, "EGL_EXT_device_drm")) {
            const char* file = egl.QueryDeviceString(handles[i], EGL_DRM_DEVICE_FILE_EXT);
            if (file) description += std::string{" ("} + file + ")";
        }
        found.push_back({std::move(description), EGL_PLATFORM_DEVICE_EXT, handles[i], software});
    }
    return found;
}

[[noreturn]] void reject_choice(const std::string& choice, std::size_t device_count) {
    throw ContextError(
        "no OpenGL context: OPACITY_EGL_DEVICE is \"" + choice +
            "\", which is none of this machine's " + std::to_string(device_count) + " EGL devices",
        device_count
            ? "set it to 0.." + std::to_string(device_count - 1) + " or to software, or unset it"
            : "unset it; " + std::string{fix});
}

// The one that OPACITY_EGL_DEVICE names; it alone is
// tried, because a silent fallback would hide the mistake.
std::optional<Candidate> chosen_device(const std::vector<Candidate>& all) {
    const char* variable = std::getenv("OPACITY_EGL_DEVICE");
    if (!variable || !*variable) return std::nullopt;
    const std::string choice = variable;
    for (std::size_t i = 0; i < all.size(); ++i) {
        const bool is_it = choice == "software" ? all[i].software : choice == std::to_string(i);
        if (is_it) return all[i];
    }
    reject_choice(choice, all.size());
}

std::vector<Candidate> candidates(const Egl& egl) {
    const std::vector<Candidate> all = devices(egl);
    if (const auto chosen = chosen_device(all)) return {*chosen};
    std::vector<Candidate> ordered;
    for (const Candidate& device : all) {
        if (!device.software) ordered.push_back(device);
    }
    if (has_extension(egl.QueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS),
                      "EGL_MESA_platform_surfaceless")) {
        ordered.push_back(
            {"EGL surfaceless", EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, false});
    }
    for (const Candidate& device : all) {
        if (device.software) ordered.push_back(device);
    }
    return ordered;
}

EGLDisplay open_display(const Egl& egl, const Candidate& candidate) {
    if (!egl.GetPlatformDisplay) throw ContextError("EGL_EXT_platform_base is missing", fix);
    const EGLDisplay display =
        egl.GetPlatformDisplay(candidate.platform, candidate.native, nullptr);
    if (display == EGL_NO_DISPLAY || !egl.Initialize(display, nullptr, nullptr)) {
        throw ContextError(egl.last_error(), fix);
    }
    const char* extensions = egl.QueryString(display, EGL_EXTENSIONS);
    if (!has_extension(extensions, "EGL_KHR_surfaceless_context")) {
        throw ContextError("EGL_KHR_surfaceless_context is missing", fix);
    }
    return display;
}

EGLConfig choose_config(const Egl& egl, EGLDisplay display) {
    const char* extensions = egl.QueryString(display, EGL_EXTENSIONS);
    if (has_extension(extensions, "EGL_KHR_no_config_context") ||
        has_extension(extensions, "EGL_MESA_configless_context")) {
        return EGL_NO_CONFIG_KHR;
    }
    const EGLint wanted[] = {EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_SURFACE_TYPE, EGL_DONT_CARE,
                             EGL_NONE};
    EGLConfig config = nullptr;
    EGLint count = 0;
    if (!egl.ChooseConfig(display, wanted, &config, 1, &count) || count == 0) {
        throw ContextError("no EGL configuration with OpenGL", fix);
    }
    return config;
}

EGLContext create_context(const Egl& egl, EGLDisplay display) {
    const EGLConfig config = choose_config(egl, display);
    const BoundApi api{egl, EGL_OPENGL_API};
    if (!api) throw ContextError("EGL without OpenGL", fix);
    const char* debug = std::getenv("OPACITY_GL_DEBUG");
    const auto create = [&](std::vector<EGLint> attributes) {
        attributes.insert(attributes.end(), {EGL_CONTEXT_MAJOR_VERSION, 4});
        attributes.insert(attributes.end(), {EGL_CONTEXT_MINOR_VERSION, 5});
        attributes.insert(attributes.end(),
                          {EGL_CONTEXT_OPENGL_PROFILE_MASK, EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT});
        attributes.insert(attributes.end(),
                          {EGL_CONTEXT_OPENGL_DEBUG, debug && *debug ? EGL_TRUE : EGL_FALSE});
        attributes.push_back(EGL_NONE);
        return egl.CreateContext(display, config, EGL_NO_CONTEXT, attributes.data());
    };
    EGLContext context =
        create({EGL_CONTEXT_OPENGL_RESET_NOTIFICATION_STRATEGY, EGL_LOSE_CONTEXT_ON_RESET});
    if (!context) context = create({});  // not every driver can tell that its device was reset
    if (!context) throw ContextError("no OpenGL 4.5 core context: " + egl.last_error(), fix);
    return context;
}

}  // namespace

std::shared_ptr<Context> Context::headless(Logger logger) {
    const Egl egl = Egl::open();
    claim_process();
    std::vector<std::string> search;
    std::string advice = fix;
    for (const Candidate& candidate : candidates(egl)) {
        try {
            const EGLDisplay display = open_display(egl, candidate);
            const EGLContext native = create_context(egl, display);
            auto context = std::make_shared<EglContext>(egl, display, native, logger, search);
            context->start();
            context->search_.push_back(candidate.description + ": " + context->renderer());
            return context;
        } catch (const ContextError& error) {
            search.push_back(candidate.description + ": " + error.problem());
            // Not for want of a driver: something better is known.
            if (error.fix() != fix) advice = error.fix();
            if (logger) logger(LogLevel::debug, search.back());
        }
    }
    if (search.empty()) search.push_back("EGL: no device and no surfaceless platform");
    std::string tried;
    for (const std::string& line : search) tried += "\n  " + line;
    throw ContextError("no OpenGL 4.5 context could be made; tried" + tried, advice);
}

}  // namespace opacity::gl
