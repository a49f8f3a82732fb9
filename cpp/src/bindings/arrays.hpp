// Arrays that cross between NumPy and the engine, one copy each way.
#pragma once

#include <pybind11/numpy.h>

#include <cstring>
#include <memory>
#include <utility>
#include <vector>

#include "bindings/bindings.hpp"
#include "opacity/core/math.hpp"
#include "opacity/scene/positions.hpp"

namespace opacity::bindings {

template <class T>
using Array = py::array_t<T, py::array::c_style>;

// Points as they come: float32 or float64, (N, 3).
Positions to_positions(const py::array& xyz);
// The same numbers, of an array that stays as it is meanwhile.
Positions borrowed_positions(const py::array& xyz);
// float32 or float64; the engine keeps float32.
std::vector<float> to_floats(const py::array& values);
std::vector<float3> to_float3s(const py::array& values);
double4x4 to_matrix(const Array<double>& matrix);
py::array from_matrix(const double4x4& matrix);

template <class T>
std::vector<T> to_vector(const Array<T>& values) {
    return {values.data(), values.data() + values.size()};
}

// The numbers of a vector as an array that owns them; nothing is copied.
template <class Number, class Element>
py::array take(std::vector<Element> values, std::vector<py::ssize_t> shape) {
    static_assert(sizeof(Element) % sizeof(Number) == 0);
    auto owner = std::make_unique<std::vector<Element>>(std::move(values));
    const auto* numbers = reinterpret_cast<const Number*>(owner->data());
    const py::capsule capsule(owner.get(),
                              [](void* v) { delete static_cast<std::vector<Element>*>(v); });
    owner.release();
    return py::array_t<Number>(std::move(shape), numbers, capsule);
}

template <class Number>
py::array take(std::vector<Number> values) {
    const auto size = static_cast<py::ssize_t>(values.size());
    return take<Number, Number>(std::move(values), {size});
}

inline py::array take(std::vector<float3> values) {
    const auto size = static_cast<py::ssize_t>(values.size());
    return take<float, float3>(std::move(values), {size, 3});
}

// T at points: (N,), or (N, 3) with a value a colour.
inline py::array with_channels(std::vector<float> values, bool is_tinted) {
    const auto size = static_cast<py::ssize_t>(values.size());
    std::vector<py::ssize_t> shape{size};
    if (is_tinted) shape = {size / 3, 3};
    return take<float, float>(std::move(values), std::move(shape));
}

}  // namespace opacity::bindings
