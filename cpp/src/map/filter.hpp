// How much each texel counts in a look-up: the integral of the filter's kernel over the texel, so
// that nothing jumps when a texel enters. On each axis alone. GLSL: lib/filter.glsl.
#pragma once

#include <algorithm>
#include <cmath>
#include <string_view>

namespace opacity {

enum class FilterKernel { none, box, bartlett, gaussian, pcf };
// By its name, as the parameter `filter` has it.
FilterKernel filter_kernel(std::string_view name);

inline constexpr float largest_filter_radius = 32.f;  // texels

// The part of the kernel left of u, where it reaches from -1 to 1.
inline float filter_sum(FilterKernel kernel, float u) {
    u = std::clamp(u, -1.f, 1.f);
    if (kernel == FilterKernel::bartlett)
        return u < 0.f ? 0.5f * (1.f + u) * (1.f + u) : 1.f - 0.5f * (1.f - u) * (1.f - u);
    if (kernel == FilterKernel::gaussian) {  // the radius is two standard deviations
        const double edge = std::erf(std::sqrt(2.0));
        return float(0.5 + 0.5 * std::erf(std::sqrt(2.0) * u) / edge);
    }
    return 0.5f + 0.5f * u;
}

// Of the texel from `begin` to begin + 1, beside a receiver at 0.
inline float filter_weight(FilterKernel kernel, float begin, float radius) {
    return filter_sum(kernel, (begin + 1.f) / radius) - filter_sum(kernel, begin / radius);
}

}  // namespace opacity
