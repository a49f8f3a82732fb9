// Where a texel lays its planes, if its layers lie between two depths and the planes are spaced alike
// in all texels: lib/layers.glsl. C++: LayerSpan.
#include "lib/planes.glsl"

struct TexelLayers {
    float start, end;  // light space
};

float position(TexelLayers layers, float depth) { return between(layers.start, layers.end, depth); }
