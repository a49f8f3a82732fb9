// Parameters: read by name from whoever owns them, so that a new one needs no line here.
#include "opacity/core/param.hpp"

#include <pybind11/stl.h>

#include "bindings/bindings.hpp"
#include "opacity/core/nearest_name.hpp"
#include "opacity/renderer.hpp"

namespace opacity::bindings {
namespace {

// What `pyopacity techniques` and the docs tell about one parameter.
struct Description {
    std::string name, type, range, doc;
    ParamValue default_value;
};

std::vector<Description> describe(const ParamOwner& owner) {
    std::vector<Description> list;
    for (const ParamBase* param : owner.params())
        list.push_back(
            {param->name(), param->type(), param->range(), param->doc(), param->default_value()});
    return list;
}

}  // namespace

void bind_params(py::module_& module) {
    py::classh<Description>(module, "Parameter",
                            "One parameter: name, type, range, default and what it does.")
        .def_readonly("name", &Description::name)
        .def_readonly("type", &Description::type)
        .def_readonly("range", &Description::range)
        .def_readonly("default", &Description::default_value)
        .def_readonly("doc", &Description::doc)
        .def("__repr__", [](const Description& self) {
            return "<Parameter " + self.name + ": " + self.type + ", " + self.range + ", default " +
                   to_string(self.default_value) + ">";
        });

    py::classh<ParamOwner>(module, "ParamOwner")
        .def_property_readonly("name", &ParamOwner::name)
        .def("parameters", &describe)
        .def("get", [](const ParamOwner& self,
                       const std::string& name) { return self.param(name).value(); })
        // A bool is tried first: for Python it is an int as well, for a parameter it is not.
        .def("set", [](ParamOwner& self, const std::string& name, const ParamValue& value) {
            self.param(name).assign(value);
        });

    // Also without a renderer: what it would refuse shows before there is a context.
    py::classh<RenderSettings, ParamOwner>(module, "RenderSettings").def(py::init<>());
    module.def("nearest_name", &nearest_name);
}

}  // namespace opacity::bindings
