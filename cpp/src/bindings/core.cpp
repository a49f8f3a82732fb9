// Formulas of the room core, for what measures them: pyopacity.stress.
#include <algorithm>

#include "bindings/arrays.hpp"
#include "bindings/bindings.hpp"
#include "opacity/core/correlation.hpp"
#include "opacity/core/split.hpp"

namespace opacity::bindings {
namespace {

double correlation(const Array<double>& x, const Array<double>& y) {
    const std::vector<double> a = to_vector(x), b = to_vector(y);
    Correlation both;
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) both.add(a[i], b[i]);
    return both.coefficient();
}

}  // namespace

void bind_core(py::module_& module) {
    module.def("correlation", &correlation);
    module.def("split_curve", py::vectorize(&split_curve));
    module.def("split_inverse", py::vectorize(&split_inverse));
    module.def("layer_planes",
               [](int layers, double ratio) { return take(layer_planes(layers, ratio)); });
}

}  // namespace opacity::bindings
