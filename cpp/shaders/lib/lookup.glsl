// What every map shares in the look-up: the front test, the opaque depth map, and the mean of T
// over the four nearest texels (of T, not of optical depth: the mean of T is what a footprint lets
// through). Include it after defining
//     float texel_transmittance(ivec2 texel, float depth)
// the fraction of light that passes the translucent casters of one texel in front of a depth.
#include "lib/light.glsl"

uniform sampler2D t_opaque_depth;
uniform float u_bias;              // world units; negative: automatic
uniform float u_receiver_width;    // world units: a strand does not shadow its own neighbourhood
uniform float u_light_least_bias;  // world units

float texel_or_opaque(ivec2 texel, float depth) {
    // A map of up to three texels has no border: its outer texels stand for what lies beside them.
    if (u_light_map_size_px < 4) texel = clamp(texel, ivec2(0), ivec2(u_light_map_size_px - 1));
    if (any(lessThan(texel, ivec2(0))) || any(greaterThanEqual(texel, ivec2(u_light_map_size_px)))) return 1.0;
    if (texelFetch(t_opaque_depth, texel, 0).x < min(depth, 1.0)) return 0.0;
    return texel_transmittance(texel, depth);
}

float shadow_transmittance(vec3 p_ls) {
    float bias = (u_bias < 0.0 ? max(u_receiver_width, u_light_least_bias) : u_bias) / u_light_depth_range;
    float depth = p_ls.z - bias;
    // Also false for a coordinate that is not finite: T = 1, never NaN.
    if (!(depth > 0.0 && all(greaterThan(p_ls.xy, vec2(-1.0))) &&
          all(lessThan(p_ls.xy, vec2(u_light_map_size_px + 1)))))
        return 1.0;
    vec2 corner = p_ls.xy - 0.5;
    ivec2 texel = ivec2(floor(corner));
    vec2 weight = corner - vec2(texel);
    float t00 = texel_or_opaque(texel, depth), t10 = texel_or_opaque(texel + ivec2(1, 0), depth);
    float t01 = texel_or_opaque(texel + ivec2(0, 1), depth);
    float t11 = texel_or_opaque(texel + ivec2(1, 1), depth);
    return mix(mix(t00, t10, weight.x), mix(t01, t11, weight.x), weight.y);
}
