// Moment opacity maps: see moment_opacity_maps.hpp.
#include "lib/layer_span.glsl"
#include "lib/moments.glsl"

TexelLayers texel_layers(ivec2 texel) { return TexelLayers(0.0, 1.0, 0); }

#include "lib/coefficients.glsl"
