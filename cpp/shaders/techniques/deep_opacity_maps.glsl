// Deep opacity maps: layers behind the first caster of each texel, all of them alike.
#include "lib/layer_map.glsl"
#include "lib/layer_span.glsl"

uniform float u_layers_depth;  // d_K: from the start of the layers to their end

#if defined(PACKED) && !defined(PASS_opacity)
float first_depth(ivec2 texel) {
    return texelFetch(t_opacity, ivec3(texel, start_slot / PLANES_AN_IMAGE), 0)[start_slot % PLANES_AN_IMAGE];
}
#else
uniform sampler2D t_start;
float first_depth(ivec2 texel) { return texelFetch(t_start, texel, 0).x; }
#endif

// z0 and z0 + d_K.
TexelLayers texel_layers(ivec2 texel) {
    float first = first_depth(texel);
    return TexelLayers(first, first + u_layers_depth, 0);
}

#include "lib/layers.glsl"
