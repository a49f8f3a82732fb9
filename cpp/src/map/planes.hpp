// Layer planes between two depths: plane 0 at the start, plane K at the end, the others where the
// split curve puts them. The deposit and the look-up share these functions, so a fragment is
// counted once whatever it lies on. GLSL: lib/planes.glsl.
#pragma once

#include <algorithm>
#include <span>

namespace opacity {

// Position between the bounds; 0 where they coincide.
inline float between(float start, float end, float depth) {
    return end > start ? std::clamp((depth - start) / (end - start), 0.f, 1.f) : 0.f;
}

// The layer j in 0 .. K - 1 with planes[j] <= x < planes[j + 1]; the last one is closed at its end.
inline int layer_of(std::span<const float> planes, float x) {
    const auto above = std::upper_bound(planes.begin() + 1, planes.end() - 1, x);
    return int(above - planes.begin()) - 1;
}

// A layer's optical depth is taken to grow evenly from one plane to the next. The part of a caster
// in layer `own` that a look-up in `layer`, so far `along` it, has counted.
inline float counted(int own, int layer, float along) {
    return own < layer ? 1.f : own > layer ? 0.f : along;
}

}  // namespace opacity
