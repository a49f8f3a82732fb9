// Particles and volumes.
#include <pybind11/stl.h>

#include <string>

#include "bindings/shape_lock.hpp"
#include "opacity/scene/particles.hpp"
#include "opacity/scene/volume.hpp"

namespace opacity::bindings {
namespace {

std::shared_ptr<Particles> make_particles(const py::array& centers, const py::array& radius,
                                          const py::array& color, const std::string& profile) {
    Positions xyz = to_positions(centers);
    std::vector<float> radii = to_floats(radius);
    std::vector<float3> colors = to_float3s(color);
    const py::gil_scoped_release release;
    return std::make_shared<Particles>(std::move(xyz), std::move(radii), std::vector{1.f},
                                       std::move(colors), density_profile(profile));
}

std::shared_ptr<Volume> make_volume(const py::array& extinction, const double3& origin,
                                    const double3& spacing, const float3& color) {
    const Volume::Size size{int(extinction.shape(0)), int(extinction.shape(1)),
                            int(extinction.shape(2))};
    std::vector<float> values = to_floats(extinction);
    const py::gil_scoped_release release;
    return std::make_shared<Volume>(size, std::move(values), origin, spacing, color);
}

py::array extinction_of(const Volume& volume) {
    std::vector<float> values = copied(volume, [](const Volume& v) { return v.extinction(); });
    const auto& [nz, ny, nx] = volume.size_zyx();
    return take<float, float>(std::move(values), {nz, ny, nx});
}

// (Z, Y, X, 3), or None.
py::object extinction_rgb_of(const Volume& volume) {
    const TintPtr tint = copied(volume, [](const Volume& v) { return v.tint(); });
    if (!tint) return py::none();
    const auto& [nz, ny, nx] = volume.size_zyx();
    return take<float, float3>(tint->rgb(), {nz, ny, nx, 3});
}

}  // namespace

void bind_media(py::module_& module) {
    py::classh<Particles, Shape>(module, "Particles")
        .def(py::init(&make_particles))
        .def("radius",
             [](const Particles& self) {
                 return take(copied(self, [](const Particles& p) { return p.radius(); }));
             })
        .def("set_radius",
             [](Particles& self, const py::array& values) {
                 std::vector<float> radius = to_floats(values);
                 without_interpreter([&] { self.set_radius(std::move(radius)); });
             })
        .def("profile",
             [](const Particles& self) {
                 return to_string(copied(self, [](const Particles& p) { return p.profile(); }));
             })
        .def("set_profile", [](Particles& self, const std::string& name) {
            without_interpreter([&] { self.set_profile(density_profile(name)); });
        });
    py::classh<Volume, Shape>(module, "Volume")
        .def(py::init(&make_volume))
        .def("size_zyx", &Volume::size_zyx)
        .def("extinction", &extinction_of)
        .def("set_extinction",
             [](Volume& self, const py::array& values) {
                 std::vector<float> extinction = to_floats(values);
                 without_interpreter([&] { self.set_extinction(std::move(extinction)); });
             })
        .def("extinction_rgb", &extinction_rgb_of)
        .def("set_extinction_rgb",
             [](Volume& self, const py::array& values) {
                 const std::vector<float3> rgb = to_float3s(values);
                 without_interpreter([&] { self.set_extinction_rgb(rgb); });
             })
        .def("origin", &Volume::origin)
        .def("spacing", &Volume::spacing)
        .def("set_grid", &Volume::set_grid, py::call_guard<py::gil_scoped_release>());
}

}  // namespace opacity::bindings
