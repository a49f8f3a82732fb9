#include "opacity/technique.hpp"

#include <pybind11/stl.h>

#include <string>

#include "bindings/bindings.hpp"
#include "opacity/plugin.hpp"

namespace opacity::bindings {
void bind_technique(py::module_& module) {
    py::classh<Technique, ParamOwner>(module, "Technique")
        .def_property_readonly("summary", &Technique::summary)
        .def_property_readonly("paper", &Technique::paper);
    module.def("technique_names", &technique_names);
    module.def("make_technique", &make_technique);
    module.def("load_plugin", [](const std::string& path) { return load_plugin(path); });
}

}  // namespace opacity::bindings
