#include "bindings/bindings.hpp"
#include "opacity/opacity.hpp"

PYBIND11_MODULE(_native, module) {
    using namespace opacity::bindings;
    module.doc() =
        "The C++ engine as pyopacity's classes see it. Private: no name here is a promise.";
    module.def("version", &opacity::version, "The engine's version, \"major.minor.patch\".");
    bind_errors(module);
    bind_core(module);
    bind_params(module);
    bind_shapes(module);
    bind_media(module);
    bind_technique(module);
    bind_lights(module);
    bind_scene(module);
    bind_trace(module);
    bind_context(module);
    bind_renderer(module);
    bind_io(module);
}
