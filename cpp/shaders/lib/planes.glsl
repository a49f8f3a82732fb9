// Layer planes between two depths: plane 0 at the start, plane K at the end, the others where the
// split curve puts them. The deposit and the look-up share these functions, so a fragment is
// counted once whatever it lies on.
#include "lib/interval.glsl"

#ifndef MOST_LAYERS
#define MOST_LAYERS 64
#endif

#ifndef CURVES
#define CURVES 1
#endif

uniform int u_layers;  // K
#ifdef TILE_PX
#include "lib/tile_planes.glsl"

// Each tile has planes of its own: a curve is its index.
float plane(int curve, int k) { return tile_plane(curve, k, u_layers); }
int layer_of(int curve, float x) { return tile_layer_of(curve, x, u_layers); }
#else
// Of [0, 1]: K + 1 for each of the split curves that texels choose from, the first 0, the last 1.
uniform float u_planes[CURVES * (MOST_LAYERS + 1)];

float plane(int curve, int k) { return u_planes[curve * (u_layers + 1) + k]; }

// The layer j in 0 .. K-1 with plane j <= x < plane j + 1; the last one is closed at its end.
int layer_of(int curve, float x) {
    int low = 0, high = u_layers;
    while (high - low > 1) {
        int middle = (low + high) / 2;
        if (x < plane(curve, middle)) high = middle;
        else low = middle;
    }
    return low;
}
#endif

// Position between the bounds; 0 where they coincide.
float between(float start, float end, float depth) {
    return end > start ? clamp((depth - start) / (end - start), 0.0, 1.0) : 0.0;
}

// Whether x lies in a layer before plane k: without looking for that layer.
bool in_front_of(int curve, int k, float x) { return k == u_layers || x < plane(curve, k); }

// The part that plane k counts of a caster from `begin` to `end`: of a point, whose begin is its end,
// all or nothing, by whether the plane lies behind its own layer.
float counted_at(int curve, int k, float begin, float end) {
    if (end > begin) return part_in_front(begin, end, plane(curve, k));
    return in_front_of(curve, k, begin) ? 1.0 : 0.0;
}

// The mean position of what plane k counts of it.
float mean_in_front(int curve, int k, float begin, float end) {
    return 0.5 * (begin + min(end, max(begin, plane(curve, k))));
}

// A layer's optical depth is taken to grow evenly from one plane to the next. The part of a caster
// that a look-up in `layer`, so far `along` it, has counted.
float counted(int curve, float begin, float end, int layer, float along) {
    if (end > begin) return mix(counted_at(curve, layer, begin, end), counted_at(curve, layer + 1, begin, end), along);
    if (in_front_of(curve, layer, begin)) return 1.0;
    return in_front_of(curve, layer + 1, begin) ? along : 0.0;
}
