// A window with an OpenGL 4.5 core context, through
// GLFW. Create, use and destroy it on the main thread.
#pragma once

#include <exception>
#include <functional>
#include <memory>
#include <string>

#include "opacity/gl/context.hpp"

namespace opacity::gl {

// Positions and sizes of the mouse are in screen coordinates, from the top left corner.
struct Drag {
    int button;  // 0 left, 1 right, 2 middle
    double x, y, dx, dy;
    bool shift, control;
};

struct Key {
    int code;  // a letter or digit as its ASCII capital, Escape 256, Enter 257: GLFW's numbers
    bool pressed;
    bool shift, control;
};

class Window : public Context {
   public:
    struct Size {
        int width, height;
    };

    // ContextError where GLFW or a display is missing. OPACITY_LIBGLFW may name the library.
    static std::shared_ptr<Window> create(int width, int height, const std::string& title,
                                          Logger logger = {}, bool visible = true);

    virtual bool should_close() const = 0;
    virtual void close() = 0;
    virtual void set_title(const std::string& title) = 0;
    virtual bool visible() const = 0;
    virtual void set_visible(bool visible) = 0;
    virtual Size framebuffer_size() const = 0;  // in pixels
    // Calls the functions below for what has happened since
    // the last poll; an exception of theirs arrives here.
    virtual void poll() = 0;
    // Draws a picture over the whole framebuffer: linear float RGBA, premultiplied, rows from
    // the top; it is encoded as sRGB here. More may be drawn on top before swap() shows it.
    virtual void present(const float* rgba, int width, int height) = 0;
    virtual void swap() = 0;
    // GLFW's own handle, a GLFWwindow*, for user interface libraries.
    virtual void* native_handle() const = 0;

    std::function<void(const Drag&)> on_drag;
    std::function<void(double dx, double dy)> on_scroll;
    std::function<void(const Key&)> on_key;

   protected:
    using Context::Context;
};

}  // namespace opacity::gl
