// Layer planes at equal steps of transmittance. GLSL: techniques/adaptive_opacity_maps.glsl.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>

namespace opacity {

// The last layer has a depth.
constexpr float last_place = 1.f - 0x1p-20f;

// Lays planes 1 .. K - 1 on [0, 1], by how much of the light is taken in front of each border of
// what is known: it grows evenly from one to the next. The first border is 0, the last 1. Of the
// planes `even_part` is spread over depth instead.
inline void lay_at_equal_steps(std::span<const float> borders, std::span<const float> taken,
                               float even_part, std::span<float> planes) {
    const float all = taken.back();
    const auto steps_at = [&](std::size_t i) {
        const float part = all > 0.f ? taken[i] / all : borders[i];
        return (1.f - even_part) * part + even_part * borders[i];
    };
    std::size_t i = 0;
    float before = 0.f, here = 0.f;
    for (std::size_t k = 1; k <= planes.size(); ++k) {
        const float wanted = float(k) / float(planes.size() + 1);
        while (i + 1 < borders.size() && !(here > wanted)) {
            before = here;
            here = steps_at(++i);
        }
        const float along = (wanted - before) / (here - before);
        const float place = borders[i - 1] * (1.f - along) + borders[i] * along;
        planes[k - 1] = std::min(place, last_place);
    }
}

}  // namespace opacity
