// Bounding opacity maps: layers between the first and the last caster of each texel.
#include "lib/layer_span.glsl"

uniform sampler2D t_start, t_end;

TexelLayers texel_layers(ivec2 texel) {
    return TexelLayers(texelFetch(t_start, texel, 0).x, texelFetch(t_end, texel, 0).x);
}

#include "lib/layers.glsl"
