// Windows. GLFW is opened at run time; its header gives the types only.
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <cstdlib>
#include <optional>
#include <utility>

#include "gl/egl.hpp"
#include "gl/library.hpp"
#include "gl/present.hpp"
#include "gl/process.hpp"
#include "opacity/core/error.hpp"
#include "opacity/gl/window.hpp"

namespace opacity::gl {
namespace {

constexpr const char* fix =
    "install libglfw3 (its Debian and Ubuntu name) and run where there is a display (DISPLAY or "
    "WAYLAND_DISPLAY is set; xvfb-run makes one); rendering to files needs neither: "
    "Context::headless";

// The functions of GLFW that are used here, in its own types.
struct Glfw {
    static Glfw open() {
        const Library library{"OPACITY_LIBGLFW", {"libglfw.so.3", "libglfw.so"}, fix};
        Glfw glfw;
        library.find(glfw.Init, "glfwInit");
        library.find(glfw.GetError, "glfwGetError");
        library.find(glfw.DefaultWindowHints, "glfwDefaultWindowHints");
        library.find(glfw.WindowHint, "glfwWindowHint");
        library.find(glfw.CreateWindow, "glfwCreateWindow");
        library.find(glfw.DestroyWindow, "glfwDestroyWindow");
        library.find(glfw.MakeContextCurrent, "glfwMakeContextCurrent");
        library.find(glfw.GetCurrentContext, "glfwGetCurrentContext");
        library.find(glfw.GetProcAddress, "glfwGetProcAddress");
        library.find(glfw.SwapInterval, "glfwSwapInterval");
        library.find(glfw.SwapBuffers, "glfwSwapBuffers");
        library.find(glfw.PollEvents, "glfwPollEvents");
        library.find(glfw.WindowShouldClose, "glfwWindowShouldClose");
        library.find(glfw.SetWindowShouldClose, "glfwSetWindowShouldClose");
        library.find(glfw.SetWindowTitle, "glfwSetWindowTitle");
        library.find(glfw.ShowWindow, "glfwShowWindow");
        library.find(glfw.HideWindow, "glfwHideWindow");
        library.find(glfw.GetWindowAttrib, "glfwGetWindowAttrib");
        library.find(glfw.GetFramebufferSize, "glfwGetFramebufferSize");
        library.find(glfw.SetWindowUserPointer, "glfwSetWindowUserPointer");
        library.find(glfw.GetWindowUserPointer, "glfwGetWindowUserPointer");
        library.find(glfw.SetCursorPosCallback, "glfwSetCursorPosCallback");
        library.find(glfw.SetScrollCallback, "glfwSetScrollCallback");
        library.find(glfw.SetKeyCallback, "glfwSetKeyCallback");
        library.find(glfw.GetMouseButton, "glfwGetMouseButton");
        library.find(glfw.GetKey, "glfwGetKey");
        return glfw;
    }

    std::string last_error() const {
        const char* description = nullptr;
        GetError(&description);
        return description ? description : "no reason given";
    }

    decltype(&glfwInit) Init;
    decltype(&glfwGetError) GetError;
    decltype(&glfwDefaultWindowHints) DefaultWindowHints;
    decltype(&glfwWindowHint) WindowHint;
    decltype(&glfwCreateWindow) CreateWindow;
    decltype(&glfwDestroyWindow) DestroyWindow;
    decltype(&glfwMakeContextCurrent) MakeContextCurrent;
    decltype(&glfwGetCurrentContext) GetCurrentContext;
    decltype(&glfwGetProcAddress) GetProcAddress;
    decltype(&glfwSwapInterval) SwapInterval;
    decltype(&glfwSwapBuffers) SwapBuffers;
    decltype(&glfwPollEvents) PollEvents;
    decltype(&glfwWindowShouldClose) WindowShouldClose;
    decltype(&glfwSetWindowShouldClose) SetWindowShouldClose;
    decltype(&glfwSetWindowTitle) SetWindowTitle;
    decltype(&glfwShowWindow) ShowWindow;
    decltype(&glfwHideWindow) HideWindow;
    decltype(&glfwGetWindowAttrib) GetWindowAttrib;
    decltype(&glfwGetFramebufferSize) GetFramebufferSize;
    decltype(&glfwSetWindowUserPointer) SetWindowUserPointer;
    decltype(&glfwGetWindowUserPointer) GetWindowUserPointer;
    decltype(&glfwSetCursorPosCallback) SetCursorPosCallback;
    decltype(&glfwSetScrollCallback) SetScrollCallback;
    decltype(&glfwSetKeyCallback) SetKeyCallback;
    decltype(&glfwGetMouseButton) GetMouseButton;
    decltype(&glfwGetKey) GetKey;
};

class GlfwWindow : public Window {
   public:
    GlfwWindow(const Glfw& glfw, std::optional<Egl> egl, GLFWwindow* window, Logger logger)
        : Window{std::move(logger), false}, glfw_{glfw}, egl_{egl}, window_{window} {}

    ~GlfwWindow() override {
        if (forked()) return;
        if (!on_owner_thread()) {
            log(LogLevel::warning,
                "a window was destroyed on a foreign thread: it stays until exit");
            return;
        }
        presenter_.reset();
        // Without glfwTerminate: the application may have windows of its own.
        glfw_.DestroyWindow(window_);
    }

    void start() {
        load(glfw_.GetProcAddress);
        const Use use{*this};
        glfw_.SwapInterval(1);
        glfw_.SetWindowUserPointer(window_, this);
        glfw_.SetCursorPosCallback(window_,
                                   [](GLFWwindow* w, double x, double y) { of(w).moved(x, y); });
        glfw_.SetScrollCallback(
            window_, [](GLFWwindow* w, double dx, double dy) { of(w).scrolled(dx, dy); });
        glfw_.SetKeyCallback(window_, [](GLFWwindow* w, int code, int, int action, int modifiers) {
            of(w).pressed(code, action, modifiers);
        });
    }

    bool should_close() const override { return glfw_.WindowShouldClose(window_); }
    void close() override { glfw_.SetWindowShouldClose(window_, GLFW_TRUE); }
    void set_title(const std::string& title) override {
        glfw_.SetWindowTitle(window_, title.c_str());
    }
    bool visible() const override { return glfw_.GetWindowAttrib(window_, GLFW_VISIBLE); }
    void set_visible(bool visible) override {
        visible ? glfw_.ShowWindow(window_) : glfw_.HideWindow(window_);
    }
    Size framebuffer_size() const override {
        Size size{};
        glfw_.GetFramebufferSize(window_, &size.width, &size.height);
        return size;
    }
    void* native_handle() const override { return window_; }

    void poll() override {
        glfw_.PollEvents();
        if (thrown_) std::rethrow_exception(std::exchange(thrown_, nullptr));
    }

    void present(const float* rgba, int width, int height) override {
        const Use use{*this};
        // It must not own the window that owns it.
        const std::shared_ptr<Context> unowned{std::shared_ptr<Context>{}, this};
        if (!presenter_) presenter_.emplace(unowned);
        const Size size = framebuffer_size();
        presenter_->draw(rgba, width, height, size.width, size.height);
    }

    void swap() override {
        const Use use{*this};
        glfw_.SwapBuffers(window_);
    }

   private:
    // What was current before a Use: GLFW's own idea of
    // it, and EGL's, which knows of headless contexts too.
    struct Previous {
        bool ours;
        GLFWwindow* window;
        std::optional<EglBinding> egl;
    };

    void make_current() override {
        Previous previous{false, glfw_.GetCurrentContext(), {}};
        previous.ours = previous.window == window_ && is_current();
        if (egl_) previous.egl.emplace(*egl_);
        if (!previous.ours) glfw_.MakeContextCurrent(window_);
        if (glfw_.GetCurrentContext() != window_) {
            throw ContextError(
                "the window's context could not be made current: " + glfw_.last_error(),
                "if this thread has a context that another library made, release it first");
        }
        previous_.push_back(previous);
    }

    void make_previous_current() noexcept override {
        const Previous previous = previous_.back();
        previous_.pop_back();
        if (previous.ours) return;
        glfw_.MakeContextCurrent(previous.window);
        if (!previous.egl || !previous.egl->context()) return;
        if (egl_->GetCurrentContext() != previous.egl->context()) {
            previous.egl->make_current(*egl_, EGL_NO_DISPLAY);
        }
    }

    static GlfwWindow& of(GLFWwindow* window) {
        // A C callback gets no more than the handle; the
        // address of a library's function is the same for all.
        static const auto user_pointer = Glfw::open().GetWindowUserPointer;
        return *static_cast<GlfwWindow*>(user_pointer(window));
    }

    // An exception must not pass through GLFW, which is C: poll() throws it again.
    template <class Function, class... Arguments>
    void call(const Function& function, Arguments&&... arguments) noexcept {
        if (!function || thrown_) return;
        try {
            function(std::forward<Arguments>(arguments)...);
        } catch (...) {
            thrown_ = std::current_exception();
        }
    }

    bool held(int left_key, int right_key) const {
        return glfw_.GetKey(window_, left_key) == GLFW_PRESS ||
               glfw_.GetKey(window_, right_key) == GLFW_PRESS;
    }

    void moved(double x, double y) {
        const double dx = x - std::exchange(x_, x), dy = y - std::exchange(y_, y);
        for (int button = 0; button < 3; ++button) {
            if (glfw_.GetMouseButton(window_, button) != GLFW_PRESS) continue;
            call(on_drag,
                 Drag{button, x, y, dx, dy, held(GLFW_KEY_LEFT_SHIFT, GLFW_KEY_RIGHT_SHIFT),
                      held(GLFW_KEY_LEFT_CONTROL, GLFW_KEY_RIGHT_CONTROL)});
        }
    }
    void scrolled(double dx, double dy) { call(on_scroll, dx, dy); }
    void pressed(int code, int action, int modifiers) {
        call(on_key, Key{code, action != GLFW_RELEASE, (modifiers & GLFW_MOD_SHIFT) != 0,
                         (modifiers & GLFW_MOD_CONTROL) != 0});
    }

    Glfw glfw_;
    std::optional<Egl> egl_;  // where the window's context is EGL's
    GLFWwindow* window_;
    std::vector<Previous> previous_;  // one for each Use that has begun
    std::optional<Presenter> presenter_;
    std::exception_ptr thrown_;
    double x_ = 0.0, y_ = 0.0;
};

GLFWwindow* open_window(const Glfw& glfw, int creation_api, int width, int height,
                        const std::string& title, bool visible) {
    const char* debug = std::getenv("OPACITY_GL_DEBUG");
    glfw.DefaultWindowHints();
    glfw.WindowHint(GLFW_CONTEXT_CREATION_API, creation_api);
    glfw.WindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
    glfw.WindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
    glfw.WindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfw.WindowHint(GLFW_OPENGL_DEBUG_CONTEXT, debug && *debug ? GLFW_TRUE : GLFW_FALSE);
    glfw.WindowHint(GLFW_VISIBLE, visible ? GLFW_TRUE : GLFW_FALSE);
    return glfw.CreateWindow(width, height, title.c_str(), nullptr, nullptr);
}

std::optional<Egl> egl_if_there() {
    try {
        return Egl::open();
    } catch (const ContextError&) {
        return std::nullopt;
    }
}

}  // namespace

std::shared_ptr<Window> Window::create(int width, int height, const std::string& title,
                                       Logger logger, bool visible) {
    if (width < 1 || height < 1) {
        throw ParameterError(
            "a window of " + std::to_string(width) + " x " + std::to_string(height),
            "choose at least 1 x 1");
    }
    const Glfw glfw = Glfw::open();
    claim_process();
    if (!glfw.Init())
        throw ContextError("no window: GLFW did not start: " + glfw.last_error(), fix);
    // EGL first, as for headless contexts: on one thread, GLX and EGL exclude each other.
    std::optional<Egl> egl = egl_if_there();
    GLFWwindow* native =
        egl ? open_window(glfw, GLFW_EGL_CONTEXT_API, width, height, title, visible) : nullptr;
    if (!native) {
        egl.reset();
        native = open_window(glfw, GLFW_NATIVE_CONTEXT_API, width, height, title, visible);
    }
    if (!native) throw ContextError("no window with OpenGL 4.5: " + glfw.last_error(), fix);
    auto window = std::make_shared<GlfwWindow>(glfw, egl, native, std::move(logger));
    window->start();
    window->search_.push_back("window: " + window->renderer());
    return window;
}

}  // namespace opacity::gl
