// Bounding opacity maps: cumulative optical depth at K planes between the first and the last caster
// of each texel.
#include "lib/planes.glsl"

#ifdef PASS_opacity
#include "lib/deposit.glsl"

uniform sampler2D t_start, t_end;

layout(location = 0) out vec4 o_planes[TARGETS];

#ifdef BLOCK_STRIDE
// The split search looks at one block of 4 x 4 texels in every BLOCK_STRIDE, both ways: blocks,
// since rasterisers skip those that are discarded whole.
bool is_sampled(ivec2 texel) { return all(equal((texel / 4) % BLOCK_STRIDE, ivec2(0))); }
#endif

// A fragment counts at every plane behind its own layer: plane k is channel (k - 1) % 4 of target
// (k - 1) / 4.
void main() {
    ivec2 texel = ivec2(gl_FragCoord.xy);
#ifdef BLOCK_STRIDE
    if (!is_sampled(texel)) discard;
#endif
    Deposit deposit = deposit_or_discard();
    float start = texelFetch(t_start, texel, 0).x, end = texelFetch(t_end, texel, 0).x;
    int layer = layer_of(between(start, end, deposit.depth));
    for (int target = 0; target < TARGETS; ++target) {
        ivec4 plane = 4 * (FIRST_TARGET + target) + ivec4(1, 2, 3, 4);
        o_planes[target] = deposit.optical_depth * vec4(greaterThan(plane, ivec4(layer)));
    }
}
#else

uniform sampler2D t_start, t_end;
uniform sampler2DArray t_opacity;

// Optical depth in front of plane k; nothing is in front of plane 0.
float plane_optical_depth(ivec2 texel, int k) {
    return k == 0 ? 0.0 : texelFetch(t_opacity, ivec3(texel, (k - 1) / 4), 0)[(k - 1) % 4];
}

float texel_transmittance(ivec2 texel, float depth) {
    float start = texelFetch(t_start, texel, 0).x;
    if (!(depth > start)) return 1.0;
    float end = texelFetch(t_end, texel, 0).x;
    if (depth >= end) return exp(-plane_optical_depth(texel, u_layers));
    float x = between(start, end, depth);
    int layer = layer_of(x);
    float along = (x - u_planes[layer]) / (u_planes[layer + 1] - u_planes[layer]);
    return exp(-mix(plane_optical_depth(texel, layer), plane_optical_depth(texel, layer + 1), along));
}

#include "lib/lookup.glsl"
#endif
