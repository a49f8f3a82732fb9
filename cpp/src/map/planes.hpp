// Layer planes between two depths: plane 0 at the start, plane K at the end, the others where the
// split curve puts them. The deposit and the look-up share these functions, so a fragment is
// counted once whatever it lies on. GLSL: lib/planes.glsl.
#pragma once

#include <algorithm>
#include <span>

#include "map/interval.hpp"

namespace opacity {

// Position between the bounds; 0 where they coincide.
inline float between(float start, float end, float depth) {
    return end > start ? std::clamp((depth - start) / (end - start), 0.f, 1.f) : 0.f;
}

// The layer j in 0 .. K - 1 with planes[j] <= x < planes[j + 1]; the last one is closed at its end.
inline int layer_of(std::span<const float> planes, float x) {
    // As std::upper_bound, without a branch that is hard to foretell.
    const float* below = planes.data();
    for (std::size_t count = planes.size() - 2; count > 0;) {
        const std::size_t half = (count + 1) / 2;
        below = x < below[half] ? below : below + half;
        count -= half;
    }
    return int(below - planes.data());
}

// Whether x lies in a layer before plane k: without looking for that layer.
inline bool in_front_of(std::span<const float> planes, int k, float x) {
    return std::size_t(k) + 1 == planes.size() || x < planes[std::size_t(k)];
}

// The part that plane k counts of a caster from `begin` to `end`: of a point, whose begin is its
// end, all or nothing, by whether the plane lies behind its own layer.
inline float counted_at(std::span<const float> planes, int k, float begin, float end) {
    if (end > begin) return part_in_front(begin, end, planes[std::size_t(k)]);
    return in_front_of(planes, k, begin) ? 1.f : 0.f;
}

// The mean position of what plane k counts of it.
inline float mean_in_front(std::span<const float> planes, int k, float begin, float end) {
    return 0.5f * (begin + std::min(end, std::max(begin, planes[std::size_t(k)])));
}

// A layer's optical depth is taken to grow evenly from one plane to the next. The part of a caster
// that a look-up in `layer`, so far `along` it, has counted.
inline float counted(std::span<const float> planes, float begin, float end, int layer,
                     float along) {
    if (end > begin)
        return counted_at(planes, layer, begin, end) * (1.f - along) +
               counted_at(planes, layer + 1, begin, end) * along;
    if (in_front_of(planes, layer, begin)) return 1.f;
    return in_front_of(planes, layer + 1, begin) ? along : 0.f;
}

}  // namespace opacity
