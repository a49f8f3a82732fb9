// An OpenGL 4.5 core context: headless through EGL, in a GLFW window, or one that the caller made.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include "opacity/core/log.hpp"

struct GladGLContext;

namespace opacity::gl {

class StateGuard;

class Context : public std::enable_shared_from_this<Context> {
   public:
    // Headless. Looks at OPACITY_EGL_DEVICE (an index, or "software") first, then EGL devices
    // (a real GPU first), then EGL surfaceless, then a software device. ContextError lists
    // what was tried and the packages to install. OPACITY_GL_DEBUG=1 asks for a debug context.
    static std::shared_ptr<Context> headless(Logger logger = {});
    // The context that is current on this thread; our calls save and restore its state.
    // `get_proc_address` is the caller's loader (eglGetProcAddress, glfwGetProcAddress, ...).
    using ProcAddress = void (*(*)(const char*))();
    static std::shared_ptr<Context> adopt(ProcAddress get_proc_address, Logger logger = {});

    virtual ~Context();
    Context(const Context&) = delete;
    Context& operator=(const Context&) = delete;

    // Makes the context current for the scope of a Use, and what was current before
    // again at its end; they nest. ContextError from a thread that did not create it,
    // or where an adopted context is not current; ForkedContextError in a forked child.
    class Use {
       public:
        explicit Use(Context& context);
        ~Use();
        Use(const Use&) = delete;
        Use& operator=(const Use&) = delete;

       private:
        std::shared_ptr<Context> context_;
    };

    const GladGLContext& gl() const { return *gl_; }
    const std::string& renderer() const {
        return renderer_;
    }  // e.g. "llvmpipe (LLVM 15.0.6, 256 bits)"
    const std::string& version() const { return version_; }
    bool is_software() const;
    // What the driver can at most do, by name: "texture size", "draw buffers", ... in its own
    // units.
    std::vector<std::pair<std::string, std::int64_t>> limits();
    bool adopted() const { return adopted_; }
    // Textures, buffers, programs and so on that are alive: 0 after the last owner is gone.
    int live_objects() const { return live_objects_; }
    // What was looked at before this context was found, a line each.
    const std::vector<std::string>& search() const { return search_; }
    void log(LogLevel level, std::string_view message) const noexcept;

    // Used by gl::Object. A name freed where the context cannot be current, such as on
    // a foreign thread, waits for the owner's next Use; after a fork it is dropped.
    void count_object(int change) noexcept { live_objects_ += change; }
    void release(int kind, unsigned name) noexcept;

   protected:
    Context(Logger logger, bool adopted);
    // The last step of creation: loads the functions, switches debug output on.
    void load(ProcAddress get_proc_address);
    // make_current / make_previous_current are no-ops for an adopted context.
    virtual void make_current() {}
    virtual void make_previous_current() noexcept {}
    bool forked() const noexcept;
    bool on_owner_thread() const noexcept { return std::this_thread::get_id() == owner_; }
    bool is_current() const noexcept;

    std::vector<std::string> search_;

   private:
    void load_functions(ProcAddress get_proc_address);
    void find_current_context_query();
    void check_usable() const;
    void enter();
    void leave() noexcept;
    void listen_to_debug_output();
    void release_queued() noexcept;

    // The window system's name for the context that is
    // current, asked of whichever of EGL and GLX made ours.
    using CurrentContext = void* (*)();

    std::unique_ptr<GladGLContext> gl_;
    Logger logger_;
    std::string renderer_, version_;
    std::thread::id owner_ = std::this_thread::get_id();
    int process_ = 0;
    int depth_ = 0;
    bool adopted_ = false;
    CurrentContext current_context_ = nullptr;
    void* native_context_ = nullptr;
    std::unique_ptr<StateGuard> callers_state_;  // of an adopted context, while it is in use
    struct Queue;
    std::unique_ptr<Queue> queue_;
    std::atomic<int> live_objects_ = 0;
};

}  // namespace opacity::gl
