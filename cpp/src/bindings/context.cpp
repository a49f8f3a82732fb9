#include "bindings/context.hpp"

#include <pybind11/stl.h>

#include "bindings/bindings.hpp"

namespace opacity::bindings {

LoggedContext LoggedContext::headless() {
    auto messages = std::make_shared<Messages>();
    const auto log = [messages](LogLevel level, std::string_view message) {
        messages->add(level, message);
    };
    return {gl::Context::headless(log), messages};
}

void bind_context(py::module_& module) {
    py::classh<LoggedContext>(module, "Context", "An OpenGL context that a renderer made.")
        .def_static("headless", &LoggedContext::headless, py::call_guard<py::gil_scoped_release>(),
                    "A context without a window; ContextError lists what was tried.")
        .def_property_readonly(
            "renderer", [](const LoggedContext& self) { return text(self.context->renderer()); },
            "What draws, as the driver calls it: \"llvmpipe (LLVM 15.0.6, 256 bits)\".")
        .def_property_readonly(
            "version", [](const LoggedContext& self) { return text(self.context->version()); },
            "The OpenGL version, as the driver writes it.")
        .def_property_readonly(
            "is_software", [](const LoggedContext& self) { return self.context->is_software(); },
            "True where the CPU draws.")
        .def(
            "limits", [](LoggedContext& self) { return self.context->limits(); },
            "What the driver can at most do: (name, number) each.")
        .def_property_readonly(
            "live_objects", [](const LoggedContext& self) { return self.context->live_objects(); },
            "OpenGL objects that are alive: 0 after the last renderer on it is closed.")
        .def_property_readonly(
            "search", [](const LoggedContext& self) { return self.context->search(); },
            "What was looked at before this context was found, a line each.")
        .def(
            "take_messages", [](LoggedContext& self) { return self.messages->take(); },
            "What OpenGL said since the last call: (level, message) each.");
}

}  // namespace opacity::bindings
