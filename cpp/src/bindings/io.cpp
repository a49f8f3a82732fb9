#include "opacity/io/load.hpp"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "bindings/arrays.hpp"
#include "bindings/messages.hpp"

namespace opacity::bindings {
namespace {

// The shapes, and the warnings that Python passes on: (level, message) each.
std::pair<std::vector<ShapePtr>, py::list> load_shapes(const std::string& path_or_name) {
    std::vector<ShapePtr> shapes;
    Messages messages;
    {
        const py::gil_scoped_release release;
        shapes = load(path_or_name, [&](LogLevel level, std::string_view message) {
            messages.add(level, message);
        });
    }
    check_signals();
    return {std::move(shapes), messages.take()};
}

void save_picture(const std::filesystem::path& path, const Array<float>& rgba) {
    Image image{static_cast<int>(rgba.shape(1)), static_cast<int>(rgba.shape(0)), to_vector(rgba)};
    {
        const py::gil_scoped_release release;
        save_png(path, image);
    }
    check_signals();
}

}  // namespace

void bind_io(py::module_& module) {
    module.def("load", &load_shapes);
    module.def("demo_names", &demo_names);
    module.def("save_png", &save_picture, py::arg("path"), py::arg("rgba").noconvert());
}

}  // namespace opacity::bindings
