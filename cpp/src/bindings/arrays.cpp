#include "bindings/arrays.hpp"

#include <algorithm>
#include <span>

#include "opacity/core/error.hpp"

namespace opacity::bindings {
namespace {

// Calls `use` with the array as what it holds. The Python layer lets nothing else through.
template <class Use>
auto as_floating(const py::array& array, Use use) {
    if (Array<float>::check_(array)) return use(py::reinterpret_borrow<Array<float>>(array));
    if (Array<double>::check_(array)) return use(py::reinterpret_borrow<Array<double>>(array));
    throw ParameterError("the array is neither float32 nor float64 in C order",
                         "pass numpy.ascontiguousarray(array, dtype=numpy.float32)");
}

}  // namespace

Positions to_positions(const py::array& xyz) {
    return as_floating(xyz, [](const auto& array) { return Positions{to_vector(array)}; });
}

Positions borrowed_positions(const py::array& xyz) {
    return as_floating(xyz, [](const auto& array) {
        return Positions::borrowed(std::span{array.data(), static_cast<std::size_t>(array.size())});
    });
}

std::vector<float> to_floats(const py::array& values) {
    return as_floating(values, [](const auto& array) {
        std::vector<float> floats(static_cast<std::size_t>(array.size()));
        std::transform(array.data(), array.data() + array.size(), floats.begin(),
                       [](auto value) { return static_cast<float>(value); });
        return floats;
    });
}

std::vector<float3> to_float3s(const py::array& values) {
    const std::vector<float> floats = to_floats(values);
    std::vector<float3> triples(floats.size() / 3);
    if (!triples.empty())
        std::memcpy(triples.data(), floats.data(), triples.size() * sizeof(float3));
    return triples;
}

double4x4 to_matrix(const Array<double>& matrix) {
    double4x4 result{};
    if (static_cast<std::size_t>(matrix.size()) != result.size())
        throw ParameterError("the matrix has " + std::to_string(matrix.size()) + " elements",
                             "pass four rows of four");
    std::copy_n(matrix.data(), result.size(), result.begin());
    return result;
}

py::array from_matrix(const double4x4& matrix) {
    return take<double, double>({matrix.begin(), matrix.end()}, {4, 4});
}

}  // namespace opacity::bindings
