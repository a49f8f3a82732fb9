// A context and what OpenGL said about its use.
#pragma once

#include <memory>

#include "bindings/messages.hpp"
#include "opacity/gl/context.hpp"

namespace opacity::bindings {

struct LoggedContext {
    std::shared_ptr<gl::Context> context;
    std::shared_ptr<Messages> messages;

    static LoggedContext headless();
};

}  // namespace opacity::bindings
