// Rendering. Whatever takes time runs without the interpreter, so that other Python threads go on.
#include "opacity/renderer.hpp"

#include <pybind11/stl.h>

#include "bindings/arrays.hpp"
#include "bindings/context.hpp"

namespace opacity::bindings {
namespace {

// Without a context it runs on the CPU.
std::unique_ptr<Renderer> make_renderer(std::shared_ptr<Scene> scene, const Camera& camera,
                                        std::shared_ptr<Technique> technique,
                                        const LoggedContext* context) {
    std::unique_ptr<Renderer> renderer;
    {
        const py::gil_scoped_release release;
        renderer = std::make_unique<Renderer>(
            context ? Renderer{std::move(scene), camera, std::move(technique), context->context}
                    : Renderer::on_cpu(std::move(scene), std::move(technique), &camera));
    }
    check_signals();
    // Ctrl-C stops a long frame at its next pass.
    renderer->set_interrupt_check([] {
        const py::gil_scoped_acquire acquire;
        check_signals();
    });
    return renderer;
}

void render(Renderer& self, Array<float>& out) {
    const std::span<float> rgba{out.mutable_data(), static_cast<std::size_t>(out.size())};
    {
        const py::gil_scoped_release release;
        self.render(rgba);
    }
    check_signals();
}

template <class Where>
py::array ask(Renderer& self, const Where& where, int light) {
    std::vector<float> result;
    bool is_tinted = false;
    {
        const py::gil_scoped_release release;
        result = self.transmittance(where, light);
        is_tinted = self.channels() > 1;
    }
    check_signals();
    return with_channels(std::move(result), is_tinted);
}

template <class Where>
void fill(Renderer& self, const Where& where, int light, Array<float>& out) {
    const std::span<float> values{out.mutable_data(), static_cast<std::size_t>(out.size())};
    {
        const py::gil_scoped_release release;
        self.transmittance(where, light, values);
    }
    check_signals();
}

py::array transmittance(Renderer& self, const py::array& xyz, int light) {
    return ask(self, borrowed_positions(xyz), light);
}
void fill_transmittance(Renderer& self, const py::array& xyz, int light, Array<float>& out) {
    fill(self, borrowed_positions(xyz), light, out);
}

py::array image(Renderer& self, const std::string& name, int light) {
    std::vector<float> values;
    {
        const py::gil_scoped_release release;
        values = self.image(name, light);
    }
    check_signals();
    const int width = self.settings().width.get(), height = self.settings().height.get();
    std::vector<py::ssize_t> shape{height, width};
    const std::size_t pixels = std::size_t(height) * width;
    if (values.size() > pixels) shape.push_back(py::ssize_t(values.size() / pixels));
    return take<float, float>(std::move(values), std::move(shape));
}

// (points (H, W, 3), bias (H, W)).
py::tuple receivers(Renderer& self) {
    PictureReceivers seen;
    {
        const py::gil_scoped_release release;
        seen = self.receivers();
    }
    check_signals();
    return py::make_tuple(
        take<double, double>(std::move(seen.points_ws), {seen.height, seen.width, 3}),
        take<float, float>(std::move(seen.bias), {seen.height, seen.width}));
}

// The rows, and the table for people that the engine makes of them.
py::tuple report(const Renderer& self) {
    py::list rows;
    for (const PassReport& row : self.report())
        rows.append(py::make_tuple(text(row.name), to_string(row.status), text(row.why), row.ms,
                                   text(row.note), row.calls));
    return py::make_tuple(rows, text(to_string(self.report())));
}

py::list memory(const Renderer& self) {
    py::list rows;
    for (const ResourceMemory& row : self.memory())
        rows.append(py::make_tuple(text(row.name), row.bytes, row.texels));
    return rows;
}

py::array read(const Renderer& self, const std::string& name) {
    TextureContent content = self.read(name);
    std::vector<py::ssize_t> shape{content.height, content.width};
    if (content.layers > 0) shape.insert(shape.begin(), content.layers);
    if (content.layers > 0 || content.channels > 1) shape.push_back(content.channels);
    return take<float, float>(std::move(content.values), std::move(shape));
}

}  // namespace

void bind_renderer(py::module_& module) {
    py::classh<Renderer>(module, "Renderer")
        .def(py::init(&make_renderer))
        .def(
            "settings", [](Renderer& self) -> RenderSettings& { return self.settings(); },
            py::return_value_policy::reference_internal)
        .def("set_technique", &Renderer::set_technique)
        .def("set_camera", &Renderer::set_camera)
        .def("set_size", &Renderer::set_size)
        .def("background", &Renderer::background)
        .def("set_background", &Renderer::set_background)
        .def("render", &render, py::arg("out").noconvert())
        .def("transmittance", &transmittance)
        .def("transmittance", &ask<Shape>)
        .def("fill_transmittance", &fill_transmittance, py::arg("where"), py::arg("light"),
             py::arg("out").noconvert())
        .def("fill_transmittance", &fill<Shape>, py::arg("where"), py::arg("light"),
             py::arg("out").noconvert())
        .def("image", &image)
        .def("receivers", &receivers)
        .def("light_from_world",
             [](const Renderer& self, int light) {
                 return from_matrix(self.light_from_world(light));
             })
        .def("texel_sides",
             [](const Renderer& self, const py::array& xyz, int light) {
                 return take(self.texel_sides(borrowed_positions(xyz), light));
             })
        .def("report", &report)
        .def("memory", &memory)
        .def("graph_dot", [](const Renderer& self) { return text(self.graph_dot()); })
        .def("read", &read)
        .def("invalidate", &Renderer::invalidate)
        .def("needs_recompute", &Renderer::needs_recompute);
}

}  // namespace opacity::bindings
