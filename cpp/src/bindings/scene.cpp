// The scene, its lights, and the camera.
#include "opacity/scene/scene.hpp"

#include <pybind11/stl.h>

#include <algorithm>

#include "bindings/arrays.hpp"
#include "bindings/bindings.hpp"
#include "opacity/scene/camera.hpp"
#include "scene/bias.hpp"
#include "scene/receivers.hpp"

namespace opacity::bindings {
namespace {

void bind_camera(py::module_& module) {
    py::classh<Camera>(module, "Camera")
        .def_static("look_at", &Camera::look_at)
        .def_static("fit",
                    [](const double3& min, const double3& max, const double3& direction,
                       const double3& up, double fov_deg) {
                        return Camera::fit(Box{min, max}, direction, up, fov_deg);
                    })
        .def("eye", &Camera::eye)
        .def("target", &Camera::target)
        .def("up", &Camera::up)
        .def("fov_deg", &Camera::fov_deg)
        .def("view_from_world",
             [](const Camera& self) { return from_matrix(self.view_from_world()); })
        .def("equals", [](const Camera& self, const Camera& other) { return self == other; });
}

}  // namespace

void bind_scene(py::module_& module) {
    bind_camera(module);
    module.def("receivers_on", [](const Shape& shape) {
        const Receivers receivers = [&] {
            const py::gil_scoped_release release;  // before the shape's lock: see shapes.cpp
            return receivers_on(shape);
        }();
        const Positions& points = receivers.world_points;
        std::vector<double> xyz;
        for (std::size_t i = 0; i < points.size(); ++i) {
            const double3 p = points[i];
            xyz.insert(xyz.end(), p.begin(), p.end());
        }
        const auto count = py::ssize_t(points.size());
        return take<double, double>(std::move(xyz), {count, 3});
    });
    py::classh<Scene>(module, "Scene")
        .def(py::init<>())
        .def("add", py::overload_cast<ShapePtr>(&Scene::add))
        .def("add", py::overload_cast<LightPtr>(&Scene::add))
        .def("remove", py::overload_cast<const ShapePtr&>(&Scene::remove))
        .def("remove", py::overload_cast<const LightPtr&>(&Scene::remove))
        .def("automatic_bias",
             [](const Scene& self, const Shape& receiver) {
                 const py::gil_scoped_release release;  // before the shape's lock: see shapes.cpp
                 const double width = (receiver.lock(), receiver.strand_width());
                 return std::max(width, least_bias(self));
             })
        .def("is_tinted", &Scene::is_tinted, py::call_guard<py::gil_scoped_release>())
        .def("bounds", [](const Scene& self) {
            const Box box = self.bounds();
            return py::make_tuple(box.min, box.max);
        });
}

}  // namespace opacity::bindings
