// Lights of every kind.
#include <pybind11/stl.h>

#include "bindings/arrays.hpp"
#include "bindings/bindings.hpp"
#include "opacity/scene/light.hpp"
#include "opacity/technique.hpp"

namespace opacity::bindings {
namespace {

double3 attenuation_of(const PositionalLight& light) {
    const Attenuation& a = light.attenuation();
    return {a.constant, a.linear, a.quadratic};
}

void bind_base(py::module_& module) {
    py::classh<Light>(module, "Light")
        .def_property_readonly("kind", &Light::kind)
        .def("color", &Light::color)
        .def("set_color", &Light::set_color)
        .def("intensity", &Light::intensity)
        .def("set_intensity", &Light::set_intensity)
        .def("set_technique", &Light::set_technique)
        .def("map_size", &Light::map_size)
        .def("set_map_size", &Light::set_map_size);
}

void bind_positional(py::module_& module) {
    py::classh<PositionalLight, Light>(module, "PositionalLight")
        .def("position", &PositionalLight::position)
        .def("set_position", &PositionalLight::set_position)
        .def("attenuation", &attenuation_of)
        .def("set_attenuation", [](PositionalLight& self, const double3& a) {
            self.set_attenuation({a[0], a[1], a[2]});
        });
    py::classh<PointLight, PositionalLight>(module, "PointLight")
        .def(py::init<double3, float3, float>());
    py::classh<SpotLight, PositionalLight>(module, "SpotLight")
        .def(py::init<double3, double3, double, float3, float>())
        .def("direction", &SpotLight::direction)
        .def("set_direction", &SpotLight::set_direction)
        .def("angle_deg", &SpotLight::angle_deg)
        .def("set_angle_deg", &SpotLight::set_angle_deg)
        .def("softness", &SpotLight::softness)
        .def("set_softness", &SpotLight::set_softness);
    py::classh<AreaLight, PositionalLight>(module, "AreaLight")
        .def(py::init<double3, double3, double3, int, float3, float>())
        .def("edge_u", &AreaLight::edge_u)
        .def("edge_v", &AreaLight::edge_v)
        .def("set_edges", &AreaLight::set_edges)
        .def("samples", &AreaLight::samples)
        .def("set_samples", &AreaLight::set_samples);
}

}  // namespace

void bind_lights(py::module_& module) {
    bind_base(module);
    py::classh<DirectionalLight, Light>(module, "DirectionalLight")
        .def(py::init<double3, float3, float>())
        .def("direction", &DirectionalLight::direction)
        .def("set_direction", &DirectionalLight::set_direction);
    bind_positional(module);
    module.def("light_points", &light_points);
}

}  // namespace opacity::bindings
