// A basis f_k of [0, 1], in which the density of the casters along a texel is told (Jansen and
// Bavoil 2010, section 5). A new one is a file under bases/, here and among the shaders, and a line
// in basis.cpp and lib/basis.glsl.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "map/expansion.hpp"

namespace opacity {

// Where f_0 is 1, the integrals of all others over everything are 0.
inline float first_whole(std::size_t k) {
    return k == 0 ? 1.f : 0.f;
}
inline double own_number(std::size_t k) {
    return double(k);
}
inline double no_margin(std::size_t) {
    return 0.0;
}

struct Basis {
    std::string_view name;
    // The mean of each f_k from begin to end; of a point, f_k there.
    void (*means)(float begin, float end, std::span<float> f);
    // Each g_k, from 0 to d, and g_k(1).
    void (*integrals)(float d, std::span<float> g);
    float (*whole)(std::size_t k) = first_whole;
    // How often f_k swings; 0 where it does not ring.
    double (*frequency)(std::size_t k) = own_number;
    // What is best left free at each end, in parts of the depths: the ends of a basis that goes
    // round are neighbours.
    double (*margin)(std::size_t count) = no_margin;
};

// The default first.
std::vector<std::string> basis_names();
const Basis& basis_of(std::string_view name);

// A density as the sum of a_k f_k.
class Series : public Expansion {
   public:
    // `inset`: what is left free at both ends, of the whole. `factors`: of the coefficients in a
    // look-up; none: all 1.
    Series(const Basis& basis, float inset, std::vector<float> factors)
        : basis_{basis}, inset_{inset}, factors_{std::move(factors)} {}

    void of_caster(float begin, float end, std::span<float> c) const override;
    float optical_depth(std::span<const float> c) const override;
    float optical_depth_before(float x, std::span<const float> c, float all) const override;

   private:
    float inset(float x) const { return inset_ * (1.f - x) + (1.f - inset_) * x; }

    const Basis& basis_;
    float inset_;
    std::vector<float> factors_;
};

// Lanczos's sigma factors, sin(x) / x of x = pi k / (n + 1): against ringing.
std::vector<float> lanczos_factors(const Basis& basis, std::size_t count);

}  // namespace opacity
