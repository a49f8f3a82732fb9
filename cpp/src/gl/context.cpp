#include "opacity/gl/context.hpp"

#include <dlfcn.h>
#include <glad/gl.h>

#include <cstdio>
#include <cstdlib>
#include <mutex>
#include <utility>

#include "gl/object.hpp"
#include "gl/process.hpp"
#include "gl/state_guard.hpp"
#include "opacity/core/error.hpp"

namespace opacity::gl {
namespace {

// The function of a library that the process has already opened; never opens one.
void* function_if_loaded(const char* library, const char* name) {
    void* handle = dlopen(library, RTLD_NOW | RTLD_NOLOAD);
    return handle ? dlsym(handle, name) : nullptr;
}

LogLevel level_of(GLenum type, GLenum severity) {
    if (severity == GL_DEBUG_SEVERITY_NOTIFICATION) return LogLevel::debug;
    if (type == GL_DEBUG_TYPE_ERROR) return LogLevel::error;
    return severity == GL_DEBUG_SEVERITY_LOW ? LogLevel::info : LogLevel::warning;
}

void GLAD_API_PTR pass_to_logger(GLenum, GLenum type, GLuint, GLenum severity, GLsizei length,
                                 const GLchar* message, const void* context) {
    static_cast<const Context*>(context)->log(level_of(type, severity),
                                              std::string_view{message, std::size_t(length)});
}

void print_to_standard_error(LogLevel, std::string_view message) {
    std::fprintf(stderr, "OpenGL: %.*s\n", int(message.size()), message.data());
}

bool debug_asked_for() {
    const char* variable = std::getenv("OPACITY_GL_DEBUG");
    return variable && *variable;
}

// An adopted context's errors would look like ours.
void forget_earlier_errors(const Context& context) {
    for (int i = 0; i < 16; ++i) {  // a lost context reports the same one for ever
        const GLenum error = context.gl().GetError();
        if (error == GL_NO_ERROR) return;
        context.log(LogLevel::warning,
                    "the caller left an OpenGL error pending: " + std::to_string(error));
    }
}

}  // namespace

struct Context::Queue {
    std::mutex mutex;
    std::vector<std::pair<Kind, GLuint>> names;
};

Context::Context(Logger logger, bool adopted)
    : gl_{std::make_unique<GladGLContext>()},
      logger_{std::move(logger)},
      process_{process_id()},
      adopted_{adopted},
      queue_{std::make_unique<Queue>()} {
    if (!logger_ && debug_asked_for()) logger_ = print_to_standard_error;
}

Context::~Context() {
    // The names of an owned context die with it; an adopted one lives on.
    if (adopted_ && !forked() && on_owner_thread() && is_current()) release_queued();
}

bool Context::forked() const noexcept {
    return process_id() != process_;
}

bool Context::is_current() const noexcept {
    if (current_context_) return current_context_() == native_context_;
    return gl_->GetString && gl_->GetString(GL_VERSION);
}

bool Context::is_software() const {
    for (const char* name : {"llvmpipe", "softpipe", "swrast", "SwiftShader"}) {
        if (renderer_.find(name) != std::string::npos) return true;
    }
    return false;
}

std::vector<std::pair<std::string, std::int64_t>> Context::limits() {
    constexpr std::pair<const char*, GLenum> names[] = {
        {"texture size", GL_MAX_TEXTURE_SIZE},
        {"texture array layers", GL_MAX_ARRAY_TEXTURE_LAYERS},
        {"draw buffers", GL_MAX_DRAW_BUFFERS},
        {"samples", GL_MAX_SAMPLES},
        {"storage buffer bytes", GL_MAX_SHADER_STORAGE_BLOCK_SIZE},
        {"storage buffers of a vertex shader", GL_MAX_VERTEX_SHADER_STORAGE_BLOCKS},
        {"images of a fragment shader", GL_MAX_FRAGMENT_IMAGE_UNIFORMS}};
    const Use use{*this};
    std::vector<std::pair<std::string, std::int64_t>> limits;
    for (const auto& [name, limit] : names) {
        GLint64 value = 0;
        gl_->GetInteger64v(limit, &value);
        limits.emplace_back(name, value);
    }
    return limits;
}

void Context::log(LogLevel level, std::string_view message) const noexcept {
    if (!logger_) return;
    try {
        logger_(level, message);
    } catch (
        ...) {  // called from destructors and from the driver, where an exception has nowhere to go
    }
}

void Context::load(ProcAddress get_proc_address) {
    make_current();
    try {
        load_functions(get_proc_address);
        find_current_context_query();
        if (!adopted_) {  // its debug output and its state are the caller's
            listen_to_debug_output();
            set_default_state(*gl_);
        }
    } catch (...) {
        make_previous_current();
        throw;
    }
    make_previous_current();
}

void Context::load_functions(ProcAddress get_proc_address) {
    const int version = gladLoadGLContext(gl_.get(), get_proc_address);
    const auto text = [&](GLenum name) {
        const GLubyte* found = gl_->GetString ? gl_->GetString(name) : nullptr;
        return std::string{found ? reinterpret_cast<const char*>(found) : ""};
    };
    renderer_ = text(GL_RENDERER);
    version_ = text(GL_VERSION);
    if (version >= GLAD_MAKE_VERSION(4, 5)) return;
    throw ContextError(version_.empty()
                           ? "no OpenGL context is current on this thread"
                           : renderer_ + " gives OpenGL " + version_ + ", 4.5 is needed",
                       "make an OpenGL 4.5 core context current first, or use Context::headless");
}

void Context::find_current_context_query() {
    struct Query {
        const char *library, *function;
    };
    for (const Query& query : {Query{"libEGL.so.1", "eglGetCurrentContext"},
                               Query{"libGLX.so.0", "glXGetCurrentContext"},
                               Query{"libGL.so.1", "glXGetCurrentContext"}}) {
        current_context_ =
            reinterpret_cast<CurrentContext>(function_if_loaded(query.library, query.function));
        native_context_ = current_context_ ? current_context_() : nullptr;
        if (native_context_) return;
    }
    current_context_ = nullptr;
}

void Context::listen_to_debug_output() {
    if (!logger_) return;
    gl_->Enable(GL_DEBUG_OUTPUT);
    gl_->Enable(GL_DEBUG_OUTPUT_SYNCHRONOUS);  // a Logger is promised the thread that renders
    gl_->DebugMessageCallback(pass_to_logger, this);
}

void Context::check_usable() const {
    if (forked()) reject_fork(process_);
    if (!on_owner_thread()) {
        throw ContextError(
            "an OpenGL context was used from a thread that did not create it",
            "give each thread its own Context (and Renderer), created on that thread");
    }
}

void Context::enter() {
    check_usable();
    make_current();
    if (adopted_ && !is_current()) {
        throw ContextError("the adopted OpenGL context is not current on this thread",
                           "make it current before calling, as it was when it was adopted");
    }
    if (adopted_ && depth_ == 0) {
        forget_earlier_errors(*this);
        callers_state_ = std::make_unique<StateGuard>(*gl_);
    }
    ++depth_;
    release_queued();
}

void Context::leave() noexcept {
    if (forked()) return;
    if (--depth_ == 0) callers_state_.reset();
    make_previous_current();
}

void Context::release(int kind, unsigned name) noexcept {
    if (forked()) return;
    try {
        const std::lock_guard lock{queue_->mutex};
        queue_->names.emplace_back(Kind(kind), name);
    } catch (...) {
        return;  // no memory to remember the name: it goes with the context
    }
    if (!on_owner_thread()) return;
    if (is_current()) return release_queued();
    if (adopted_) return;
    try {
        make_current();
    } catch (...) {
        return;  // at exit the driver may already be gone, and the object with it
    }
    release_queued();
    make_previous_current();
}

void Context::release_queued() noexcept {
    std::vector<std::pair<Kind, GLuint>> names;
    {
        const std::lock_guard lock{queue_->mutex};
        names.swap(queue_->names);
    }
    for (const auto& [kind, name] : names) delete_name(*gl_, kind, name);
}

Context::Use::Use(Context& context) : context_{context.shared_from_this()} {
    context_->enter();
}

Context::Use::~Use() {
    context_->leave();
}

std::shared_ptr<Context> Context::adopt(ProcAddress get_proc_address, Logger logger) {
    if (!get_proc_address) {
        throw ParameterError("Context::adopt was given no loader function",
                             "pass eglGetProcAddress, glfwGetProcAddress or your toolkit's");
    }
    struct Adopted : Context {
        explicit Adopted(Logger l) : Context{std::move(l), true} {}
        using Context::load;
    };
    const auto context = std::make_shared<Adopted>(std::move(logger));
    context->load(get_proc_address);
    context->search_.push_back("adopted: " + context->renderer());
    return context;
}

}  // namespace opacity::gl
