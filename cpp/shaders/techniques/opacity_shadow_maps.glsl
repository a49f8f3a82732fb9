// Opacity shadow maps: layers between slices of the whole map, across the light.
#include "lib/layer_span.glsl"

TexelLayers texel_layers(ivec2 texel) { return TexelLayers(0.0, 1.0, 0); }

#include "lib/layers.glsl"
