// Layer planes between two depths: plane 0 at the start, plane K at the end, the others where the
// split curve puts them. The deposit and the look-up share these functions, so a fragment is
// counted once whatever it lies on.
#include "lib/interval.glsl"

#ifndef MOST_LAYERS
#define MOST_LAYERS 64
#endif

uniform int u_layers;                       // K
uniform float u_planes[MOST_LAYERS + 1];    // of [0, 1]; u_planes[0] = 0, u_planes[K] = 1

// Position between the bounds; 0 where they coincide.
float between(float start, float end, float depth) {
    return end > start ? clamp((depth - start) / (end - start), 0.0, 1.0) : 0.0;
}

// The layer j in 0 .. K-1 with u_planes[j] <= x < u_planes[j + 1]; the last one is closed at its
// end.
int layer_of(float x) {
    int low = 0, high = u_layers;
    while (high - low > 1) {
        int middle = (low + high) / 2;
        if (x < u_planes[middle]) high = middle;
        else low = middle;
    }
    return low;
}

// The part that plane k counts of a caster from `begin` to `end`: of a point, whose begin is its end,
// all or nothing, by whether the plane lies behind its own layer.
float counted_at(int k, float begin, float end) {
    if (end > begin) return part_in_front(begin, end, u_planes[k]);
    return k > layer_of(begin) ? 1.0 : 0.0;
}

// The mean position of what plane k counts of it.
float mean_in_front(int k, float begin, float end) { return 0.5 * (begin + min(end, max(begin, u_planes[k]))); }

// A layer's optical depth is taken to grow evenly from one plane to the next. The part of a caster
// that a look-up in `layer`, so far `along` it, has counted.
float counted(float begin, float end, int layer, float along) {
    if (end > begin) return mix(counted_at(layer, begin, end), counted_at(layer + 1, begin, end), along);
    int own = layer_of(begin);
    return own < layer ? 1.0 : own > layer ? 0.0 : along;
}
