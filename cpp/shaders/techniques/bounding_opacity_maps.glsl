// Bounding opacity maps: layers between the first and the last caster of each texel.
#include "lib/layer_span.glsl"

uniform sampler2D t_start, t_end;

#if CURVES > 1
uniform sampler2D t_split_ratios;  // of each square of REGION_PX texels

int curve_of(ivec2 texel) {
    return int(float(CURVES - 1) * texelFetch(t_split_ratios, texel / REGION_PX, 0).x + 0.5);
}
#else
int curve_of(ivec2 texel) { return 0; }
#endif

TexelLayers texel_layers(ivec2 texel) {
    return TexelLayers(texelFetch(t_start, texel, 0).x, texelFetch(t_end, texel, 0).x, curve_of(texel));
}

#include "lib/layers.glsl"
