// Rays. The interpreter is free meanwhile; some twenty times a second it is asked for Ctrl-C.
#include "opacity/trace.hpp"

#include <pybind11/stl.h>

#include "bindings/arrays.hpp"
#include "bindings/bindings.hpp"

namespace opacity::bindings {
namespace {

// What the caller wants to hear, or None.
std::function<void(double)> told(const py::object& progress) {
    return [&progress](double fraction) {
        const py::gil_scoped_acquire acquire;
        check_signals();
        if (!progress.is_none()) progress(fraction);
    };
}

using Indices = std::optional<Array<std::uint32_t>>;

std::optional<std::vector<std::size_t>> chosen(const Indices& indices) {
    if (!indices) return {};
    return std::vector<std::size_t>{indices->data(), indices->data() + indices->size()};
}

template <class Where>
py::array trace_at(const Scene& scene, const Where& where, int light,
                   const Array<double>& footprint, int samples, const Array<double>& bias,
                   const Indices& indices, const std::string& backend, const py::object& progress) {
    const TraceSettings settings{
        light, to_vector(footprint), samples, to_vector(bias), chosen(indices), backend,
        0,     told(progress)};
    std::vector<float> result;
    bool is_tinted = false;
    {
        const py::gil_scoped_release release;
        result = trace_transmittance(scene, where, settings);
        is_tinted = scene.is_tinted();
    }
    check_signals();
    return with_channels(std::move(result), is_tinted);
}

py::array trace(const Scene& scene, const py::array& xyz, int light, const Array<double>& footprint,
                int samples, const Array<double>& bias, const Indices& indices,
                const std::string& backend, const py::object& progress) {
    return trace_at(scene, to_positions(xyz), light, footprint, samples, bias, indices, backend,
                    progress);
}

}  // namespace

void bind_trace(py::module_& module) {
    module.def("trace_backends", &trace_backends);
    module.def("trace_transmittance", &trace);
    module.def("trace_transmittance_of", &trace_at<Shape>);
}

}  // namespace opacity::bindings
