// Layer planes between two depths: plane 0 at the start, plane K at the end, the others where the
// split curve puts them. The deposit and the look-up share these functions, so a fragment is
// counted once whatever it lies on.

uniform int u_layers;         // K
uniform float u_planes[65];   // of [0, 1]; u_planes[0] = 0, u_planes[K] = 1

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

// A layer's optical depth is taken to grow evenly from one plane to the next. The part of a caster
// in layer `own` that a look-up in `layer`, so far `along` it, has counted.
float counted(int own, int layer, float along) { return own < layer ? 1.0 : own > layer ? 0.0 : along; }
