#include "opacity/technique.hpp"

#include <pybind11/stl.h>

#include "bindings/bindings.hpp"

namespace opacity::bindings {

void bind_technique(py::module_& module) {
    py::classh<Technique, ParamOwner>(module, "Technique")
        .def_property_readonly("summary", &Technique::summary)
        .def_property_readonly("paper", &Technique::paper);
    module.def("technique_names", &technique_names);
    module.def("make_technique", &make_technique);
}

}  // namespace opacity::bindings
