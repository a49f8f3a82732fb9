// Strands and meshes, and what all shapes share.
#include <pybind11/stl.h>

#include <optional>
#include <tuple>

#include "bindings/shape_lock.hpp"
#include "opacity/scene/mesh.hpp"
#include "opacity/scene/strands.hpp"

namespace opacity::bindings {
namespace {

py::array points_of(const Shape& shape) {
    Positions points = copied(shape, [](const Shape& s) { return s.points(); });
    const auto size = static_cast<py::ssize_t>(points.size());
    return points.visit([size](const auto& xyz) {
        using Number = typename std::decay_t<decltype(xyz)>::value_type;
        return take<Number, Number>(std::vector<Number>{xyz.begin(), xyz.end()}, {size, 3});
    });
}

py::tuple bounds_of(const Shape& shape) {
    const Box box = copied(shape, [](const Shape& s) { return s.bounds(); });
    return py::make_tuple(box.min, box.max);
}

// (N, 3), or None.
py::object tint_of(const Shape& shape) {
    const TintPtr tint = copied(shape, [](const Shape& s) { return s.tint(); });
    return tint ? py::object{take(tint->rgb())} : py::none();
}

template <class Class>
void bind_attributes(Class& shape) {
    shape.def("points", &points_of)
        .def("set_points",
             [](Shape& self, const py::array& xyz) {
                 Positions points = to_positions(xyz);
                 without_interpreter([&] { self.set_points(std::move(points)); });
             })
        .def("point_count",
             [](const Shape& self) {
                 return copied(self, [](const Shape& s) { return s.points().size(); });
             })
        .def("opacity",
             [](const Shape& self) {
                 return take(copied(self, [](const Shape& s) { return s.opacity(); }));
             })
        .def("set_opacity",
             [](Shape& self, const py::array& values) {
                 std::vector<float> opacity = to_floats(values);
                 without_interpreter([&] { self.set_opacity(std::move(opacity)); });
             })
        .def("opacity_rgb", &tint_of)
        .def("set_opacity_rgb",
             [](Shape& self, const py::array& values) {
                 const std::vector<float3> rgb = to_float3s(values);
                 without_interpreter([&] { self.set_opacity_rgb(rgb); });
             })
        .def("color",
             [](const Shape& self) {
                 return take(copied(self, [](const Shape& s) { return s.color(); }));
             })
        .def("set_color", [](Shape& self, const py::array& values) {
            std::vector<float3> color = to_float3s(values);
            without_interpreter([&] { self.set_color(std::move(color)); });
        });
}

template <class Class>
void bind_placement(Class& shape) {
    shape
        .def("transform",
             [](const Shape& self) {
                 return from_matrix(copied(self, [](const Shape& s) { return s.transform(); }));
             })
        .def("set_transform",
             [](Shape& self, const Array<double>& matrix) {
                 const double4x4 transform = to_matrix(matrix);
                 without_interpreter([&] { self.set_transform(transform); });
             })
        .def("casts", &Shape::casts)
        .def("set_casts", &Shape::set_casts, py::call_guard<py::gil_scoped_release>())
        .def("receives", &Shape::receives)
        .def("set_receives", &Shape::set_receives, py::call_guard<py::gil_scoped_release>())
        .def("instance", &Shape::instance, py::call_guard<py::gil_scoped_release>())
        .def("bounds", &bounds_of);
}

// Both are made of points, of indices that join them, of one attribute of their own (the width, the
// normals), and of colour; opacity is set afterwards.
template <class ShapeType, class Index, auto to_own>
std::shared_ptr<ShapeType> make(const py::array& points, const Array<Index>& indices,
                                const py::array& own, const py::array& color) {
    Positions xyz = to_positions(points);
    std::vector<Index> joined = to_vector(indices);
    auto own_values = to_own(own);
    std::vector<float3> colors = to_float3s(color);
    const py::gil_scoped_release release;
    return std::make_shared<ShapeType>(std::move(xyz), std::move(joined), std::move(own_values),
                                       std::vector{1.f}, std::move(colors));
}

void bind_strands(py::module_& module) {
    py::classh<Strands, Shape>(module, "Strands")
        .def(py::init(&make<Strands, std::int64_t, &to_floats>))
        .def("offsets", [](const Strands& self) { return take(self.offsets()); })
        .def("width",
             [](const Strands& self) {
                 return take(copied(self, [](const Strands& s) { return s.width(); }));
             })
        .def("set_width",
             [](Strands& self, const py::array& values) {
                 std::vector<float> width = to_floats(values);
                 without_interpreter([&] { self.set_width(std::move(width)); });
             })
        .def("segment_count", [](const Strands& self) { return self.segments().size(); });
}

TextureMapPtr to_map(const std::optional<Array<float>>& image) {
    if (!image) return {};
    const int channels = image->ndim() > 2 ? int(image->shape(2)) : 1;
    return std::make_shared<TextureMap>(
        TextureMap{int(image->shape(1)), int(image->shape(0)), channels, to_vector(*image)});
}

py::object from_map(const TextureMapPtr& map) {
    if (!map) return py::none();
    std::vector<py::ssize_t> shape{map->height, map->width};
    if (map->channels > 1) shape.push_back(map->channels);
    return take<float, float>(map->values, std::move(shape));
}

std::vector<float2> to_float2s(const py::array& values) {
    const std::vector<float> floats = to_floats(values);
    std::vector<float2> pairs(floats.size() / 2);
    if (!pairs.empty()) std::memcpy(pairs.data(), floats.data(), pairs.size() * sizeof(float2));
    return pairs;
}

template <class Class>
void bind_maps(Class& mesh) {
    mesh.def("uvs",
             [](const Mesh& self) {
                 auto uvs = copied(self, [](const Mesh& m) { return m.uvs(); });
                 const auto count = static_cast<py::ssize_t>(uvs.size());
                 return take<float, float2>(std::move(uvs), {count, 2});
             })
        .def("set_uvs",
             [](Mesh& self, const py::array& values) {
                 std::vector<float2> uvs = to_float2s(values);
                 without_interpreter([&] { self.set_uvs(std::move(uvs)); });
             })
        .def("alpha",
             [](const Mesh& self) {
                 const auto [map, mode, cutoff] = copied(self, [](const Mesh& m) {
                     return std::tuple{m.alpha_map(), m.alpha_mode(), m.alpha_cutoff()};
                 });
                 return py::make_tuple(from_map(map), to_string(mode), cutoff);
             })
        .def("set_alpha",
             [](Mesh& self, const std::optional<Array<float>>& image, const std::string& mode,
                float cutoff) {
                 TextureMapPtr map = to_map(image);
                 without_interpreter(
                     [&] { self.set_alpha(std::move(map), alpha_mode(mode), cutoff); });
             })
        .def("color_map",
             [](const Mesh& self) {
                 return from_map(copied(self, [](const Mesh& m) { return m.color_map(); }));
             })
        .def("set_color_map", [](Mesh& self, const std::optional<Array<float>>& image) {
            TextureMapPtr map = to_map(image);
            without_interpreter([&] { self.set_color_map(std::move(map)); });
        });
}

void bind_mesh(py::module_& module) {
    py::classh<Mesh, Shape> mesh(module, "Mesh");
    bind_maps(mesh);
    mesh.def(py::init(&make<Mesh, std::uint32_t, &to_float3s>))
        .def("triangles",
             [](const Mesh& self) {
                 std::vector<std::uint32_t> indices = self.triangles();
                 const auto count = static_cast<py::ssize_t>(indices.size() / 3);
                 return take<std::uint32_t, std::uint32_t>(std::move(indices), {count, 3});
             })
        .def("normals",
             [](const Mesh& self) {
                 return take(copied(self, [](const Mesh& m) { return m.normals(); }));
             })
        .def("set_normals", [](Mesh& self, const py::array& values) {
            std::vector<float3> normals = to_float3s(values);
            without_interpreter([&] { self.set_normals(std::move(normals)); });
        });
}

}  // namespace

void bind_shapes(py::module_& module) {
    py::classh<Shape> shape(module, "Shape");
    shape.def_property_readonly("kind", &Shape::kind).def("opaque", [](const Shape& self) {
        return copied(self, [](const Shape& s) { return s.opaque(); });
    });
    bind_attributes(shape);
    bind_placement(shape);
    bind_strands(module);
    bind_mesh(module);
}

}  // namespace opacity::bindings
