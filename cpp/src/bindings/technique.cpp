#include "opacity/technique.hpp"

#include <pybind11/stl.h>

#include <string>
#include <utility>
#include <vector>

#include "bindings/bindings.hpp"
#include "opacity/plugin.hpp"
#include "opacity/technique_description.hpp"

namespace opacity::bindings {
namespace {

// The dataclasses of pyopacity/described.py, field for field.
template <class T>
T field(const py::handle& owner, const char* name) {
    return owner.attr(name).cast<T>();
}

ParamDescription parameter(const py::handle& p) {
    const auto [min, max] = field<std::pair<double, double>>(p, "range");
    return {.name = field<std::string>(p, "name"),
            .initial = field<ParamValue>(p, "default"),
            .range = {min, max},
            .choices = field<std::vector<std::string>>(p, "choices"),
            .doc = field<std::string>(p, "doc")};
}

TextureDescription texture(const py::handle& t) {
    return {.name = field<std::string>(t, "name"),
            .format = field<std::string>(t, "format"),
            .layers = field<int>(t, "layers")};
}

PassDescription pass(const py::handle& p) {
    return {.name = field<std::string>(p, "name"),
            .writes = field<std::vector<std::string>>(p, "writes"),
            .reads = field<std::vector<std::string>>(p, "reads"),
            .over = field<std::string>(p, "over"),
            .fragment = field<std::string>(p, "fragment"),
            .optical_depth = field<bool>(p, "optical_depth"),
            .depth = field<std::string>(p, "depth"),
            .blend = field<std::string>(p, "blend")};
}

void register_described(const py::object& d) {
    TechniqueDescription description{
        .name = field<std::string>(d, "name"),
        .summary = field<std::string>(d, "summary"),
        .paper = field<std::string>(d, "paper"),
        .shader = field<std::string>(d, "shader"),
        .look_up = field<std::vector<std::string>>(d, "look_up"),
        .own_correction = field<bool>(d, "own_correction"),
    };
    for (const py::handle p : d.attr("parameters")) description.parameters.push_back(parameter(p));
    for (const py::handle t : d.attr("textures")) description.textures.push_back(texture(t));
    for (const py::handle p : d.attr("passes")) description.passes.push_back(pass(p));
    register_technique(std::move(description));
}

}  // namespace

void bind_technique(py::module_& module) {
    py::classh<Technique, ParamOwner>(module, "Technique")
        .def_property_readonly("summary", &Technique::summary)
        .def_property_readonly("paper", &Technique::paper);
    module.def("technique_names", &technique_names);
    module.def("make_technique", &make_technique);
    module.def("register_technique", &register_described);
    module.def("load_plugin", [](const std::string& path) { return load_plugin(path); });
}

}  // namespace opacity::bindings
