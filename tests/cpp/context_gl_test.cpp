// Contexts: where they come from, and who may use them.
#include "opacity/gl/context.hpp"

#include <doctest/doctest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "gl/buffer.hpp"
#include "gl_context.hpp"
#include "opacity/core/error.hpp"
#include "opacity/gl/window.hpp"

namespace gl = opacity::gl;

namespace {

// Sets an environment variable for one scope.
class Environment {
   public:
    Environment(const char* name, const char* value) : name_{name} {
        if (const char* before = std::getenv(name)) before_ = before;
        setenv(name, value, 1);
    }
    ~Environment() { before_ ? setenv(name_, before_->c_str(), 1) : unsetenv(name_); }

   private:
    const char* name_;
    std::optional<std::string> before_;
};

// The exit status of `work` in a forked child; 99 if it hangs.
int status_in_fork(const std::function<int()>& work) {
    const pid_t child = fork();
    if (child == 0) _exit(work());
    for (int wait_ms = 0; wait_ms < 10000; wait_ms += 10) {
        int status = 0;
        if (waitpid(child, &status, WNOHANG) == child)
            return WIFEXITED(status) ? WEXITSTATUS(status) : 98;
        std::this_thread::sleep_for(std::chrono::milliseconds{10});
    }
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
    return 99;
}

}  // namespace

TEST_CASE("a headless context renders and says what it is") {
    const auto context = context_or_skip();
    if (!context) return;
    CHECK(render_one_texel(context, 0.625f) == 0.625f);
    CHECK_FALSE(context->renderer().empty());
    CHECK_FALSE(context->search().empty());
    CHECK_FALSE(context->adopted());
    CHECK(context->is_software() == (context->renderer().find("llvmpipe") != std::string::npos));
    CHECK(context->live_objects() == 0);
}

TEST_CASE("two contexts in two threads") {
    if (!context_or_skip()) return;
    float found[2] = {};
    std::vector<std::thread> threads;
    for (int i = 0; i < 2; ++i) {
        threads.emplace_back([&found, i] {
            const auto context = gl::Context::headless();
            for (int n = 0; n < 20; ++n) found[i] = render_one_texel(context, float(i + 1));
        });
    }
    for (std::thread& thread : threads) thread.join();
    CHECK(found[0] == 1.f);
    CHECK(found[1] == 2.f);
}

TEST_CASE("two contexts on one thread interleave, and one outlives the other") {
    const auto first = context_or_skip();
    if (!first) return;
    auto second = gl::Context::headless();
    {
        const gl::Context::Use use_first{*first};
        first->gl().LineWidth(3.f);
        {
            const gl::Context::Use use_second{*second};
            CHECK(get(second->gl(), GL_LINE_WIDTH) == 1);
            const gl::Context::Use use_first_again{*first};
            CHECK(get(first->gl(), GL_LINE_WIDTH) == 3);
        }
        CHECK(get(first->gl(), GL_LINE_WIDTH) == 3);
    }
    second.reset();
    CHECK(render_one_texel(first, 0.25f) == 0.25f);
}

TEST_CASE("a context belongs to the thread that made it") {
    const auto context = context_or_skip();
    if (!context) return;
    std::string message;
    std::thread{[&] {
        try {
            const gl::Context::Use use{*context};
        } catch (const opacity::ContextError& error) {
            message = error.what();
        }
    }}.join();
    CHECK(message.find("thread") != std::string::npos);
    CHECK(message.find("fix:") != std::string::npos);
}

TEST_CASE("a forked child gets an error, not a hang") {
    const auto context = context_or_skip();
    if (!context) return;
    gl::Buffer buffer{context, 64};
    CHECK(status_in_fork([&] {
              try {
                  const gl::Context::Use use{*context};
              } catch (const opacity::ForkedContextError& error) {
                  return std::strstr(error.what(), "spawn") ? 0 : 2;
              }
              return 1;
          }) == 0);
    CHECK(status_in_fork([&] {
              try {
                  gl::Context::headless();
              } catch (const opacity::ForkedContextError&) {
                  buffer = {};  // objects die in the child without a call into the driver
                  return 0;
              }
              return 1;
          }) == 0);
    CHECK(render_one_texel(context, 0.5f) == 0.5f);
}

TEST_CASE("without libEGL the error names the packages") {
    const Environment library{"OPACITY_LIBEGL", "/nonexistent/libEGL.so.1"};
    try {
        gl::Context::headless();
        FAIL("a context without libEGL");
    } catch (const opacity::ContextError& error) {
        CHECK(error.problem().find("/nonexistent/libEGL.so.1") != std::string::npos);
        CHECK(error.fix().find("libegl1") != std::string::npos);
        CHECK(error.fix().find("libgl1-mesa-dri") != std::string::npos);
    }
}

TEST_CASE("a library that is not EGL is an error too") {
    const Environment library{"OPACITY_LIBEGL", "libdl.so.2"};
    CHECK_THROWS_AS(gl::Context::headless(), opacity::ContextError);
}

TEST_CASE("without GLFW or a display the error names both") {
    const Environment library{"OPACITY_LIBGLFW", "/nonexistent/libglfw.so.3"};
    try {
        gl::Window::create(64, 64, "test");
        FAIL("a window without GLFW");
    } catch (const opacity::ContextError& error) {
        CHECK(error.fix().find("libglfw3") != std::string::npos);
        CHECK(error.fix().find("DISPLAY") != std::string::npos);
    }
}

TEST_CASE("OPACITY_EGL_DEVICE chooses a device, or fails") {
    if (!context_or_skip()) return;
    {
        const Environment device{"OPACITY_EGL_DEVICE", "12345"};
        CHECK_THROWS_WITH_AS(gl::Context::headless(), doctest::Contains("12345"),
                             opacity::ContextError);
    }
    const Environment device{"OPACITY_EGL_DEVICE", "software"};
    try {
        const auto software = gl::Context::headless();
        CHECK(software->is_software());
    } catch (const opacity::ContextError& error) {
        MESSAGE("no software device here: ", std::string{error.what()});
    }
}

TEST_CASE("OpenGL's debug output reaches the logger") {
    if (!context_or_skip()) return;
    const Environment debug{"OPACITY_GL_DEBUG", "1"};
    std::vector<std::string> errors;
    const auto context =
        gl::Context::headless([&](opacity::LogLevel level, std::string_view message) {
            if (level == opacity::LogLevel::error) errors.emplace_back(message);
        });
    const gl::Context::Use use{*context};
    context->gl().Enable(GL_TEXTURE_2D + 12345);
    CHECK(errors.size() == 1);
    CHECK(context->gl().GetError() == GL_INVALID_ENUM);
}

TEST_CASE("a window presents a picture") {
    std::shared_ptr<gl::Window> window;
    try {
        window = gl::Window::create(64, 48, "test", {}, false);
    } catch (const opacity::ContextError& error) {
        MESSAGE("skipped, no window here: ", std::string{error.what()});
        return;
    }
    const std::vector<float> picture = {
        1.f, 0.f, 0.f, 1.f, 1.f, 0.f, 0.f, 1.f,   // top row: red
        0.f, 0.f, .5f, 1.f, 0.f, 0.f, .5f, 1.f};  // bottom row: half blue
    window->poll();
    window->present(picture.data(), 2, 2);
    const auto headless = gl::Context::headless();
    {
        const gl::Context::Use use{*window};
        CHECK(render_one_texel(headless, 0.5f) == 0.5f);  // inside the window's Use
        const gl::Window::Size size = window->framebuffer_size();
        unsigned char bottom[4], top[4];
        window->gl().ReadPixels(0, 0, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, bottom);
        window->gl().ReadPixels(0, size.height - 1, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, top);
        CHECK(int(top[0]) == 255);
        CHECK(int(bottom[0]) == 0);
        CHECK(int(bottom[2]) == doctest::Approx(188).epsilon(0.01));  // sRGB of one half
    }
    window->swap();
    CHECK_FALSE(window->should_close());
    window->close();
    CHECK(window->should_close());
    CHECK(render_one_texel(headless, 0.5f) == 0.5f);
}
