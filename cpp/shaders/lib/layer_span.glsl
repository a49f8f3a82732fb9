// Where a texel lays its planes, if its layers lie between two depths: lib/layers.glsl. C++: LayerSpan.
#include "lib/planes.glsl"

struct TexelLayers {
    float start, end;  // light space
    int curve;         // that spaces its planes; 0 where all texels are alike
};

float position(TexelLayers layers, float depth) { return between(layers.start, layers.end, depth); }
