#include "map/basis.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "map/bases/cosine.hpp"
#include "map/bases/fourier.hpp"
#include "map/bases/legendre.hpp"
#include "map/bases/piecewise_constant.hpp"

namespace opacity {
namespace {

constexpr std::array bases{fourier::basis, piecewise_constant::basis, cosine::basis,
                           legendre::basis};

}  // namespace

std::vector<std::string> basis_names() {
    std::vector<std::string> names;
    for (const Basis& basis : bases) names.emplace_back(basis.name);
    return names;
}

const Basis& basis_of(std::string_view name) {
    return *std::find_if(bases.begin(), bases.end(),
                         [&](const Basis& basis) { return basis.name == name; });
}

std::vector<float> lanczos_factors(const Basis& basis, std::size_t count) {
    const double beyond = std::numbers::pi / (basis.frequency(count - 1) + 1.0);
    std::vector<float> factors(count, 1.f);
    for (std::size_t k = 0; k < count; ++k)
        if (const double x = beyond * basis.frequency(k); x > 0.0)
            factors[k] = float(std::sin(x) / x);
    return factors;
}

void Series::of_caster(float begin, float end, std::span<float> c) const {
    basis_.means(inset(begin), inset(end), c);
}

float Series::optical_depth(std::span<const float> c) const {
    float sum = 0.f;
    for (std::size_t k = 0; k < c.size(); ++k) sum += basis_.whole(k) * c[k];
    return sum;
}

// T(d) = exp(-sum a_k g_k(d)).
float Series::optical_depth_before(float x, std::span<const float> c, float /*all*/) const {
    std::array<float, most_coefficients> storage;
    const std::span<float> g = std::span{storage}.first(c.size());
    basis_.integrals(inset(x), g);
    float sum = 0.f;
    for (std::size_t k = 0; k < c.size(); ++k)
        sum += (factors_.empty() ? 1.f : factors_[k]) * c[k] * g[k];
    return sum;
}

}  // namespace opacity
