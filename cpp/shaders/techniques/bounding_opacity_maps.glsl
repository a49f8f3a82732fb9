// Bounding opacity maps: cumulative optical depth at K planes between the first and the last caster
// of each texel.
#include "lib/planes.glsl"

#ifdef PASS_opacity
#include "lib/deposit.glsl"

uniform sampler2D t_start, t_end;

layout(location = 0) out vec4 o_planes[TARGETS];

// The split search looks at one block of 4 x 4 texels in every BLOCK_STRIDE, both ways: blocks,
// since rasterisers skip those that are discarded whole.
bool is_sampled(ivec2 texel) { return all(equal((texel / 4) % BLOCK_STRIDE, ivec2(0))); }

// A point counts at every plane behind its own layer, an interval in part at those inside it: plane k
// is channel (k - 1) % 4 of target (k - 1) / 4.
void main() {
    ivec2 texel = ivec2(gl_FragCoord.xy);
    if (!is_sampled(texel)) discard;
    Deposit deposit = deposit_or_discard();
    float start = texelFetch(t_start, texel, 0).x, end = texelFetch(t_end, texel, 0).x;
    float first = between(start, end, deposit.depth), last = between(start, end, deposit.depth_end);
    int layer = layer_of(first);
    for (int target = 0; target < TARGETS; ++target) {
        ivec4 plane = 4 * (FIRST_TARGET + target) + ivec4(1, 2, 3, 4);
        vec4 part = vec4(greaterThan(plane, ivec4(layer)));
        if (last > first)
            for (int i = 0; i < 4; ++i) part[i] = counted_at(plane[i], first, last);
        o_planes[target] = deposit.optical_depth * part;
    }
}
#else

#include "lib/receiver.glsl"

uniform sampler2D t_start, t_end;
uniform sampler2DArray t_opacity;

// Optical depth in front of plane k; nothing is in front of plane 0.
float plane_optical_depth(ivec2 texel, int k) {
    return k == 0 ? 0.0 : texelFetch(t_opacity, ivec3(texel, (k - 1) / 4), 0)[(k - 1) % 4];
}

float texel_optical_depth(ivec2 texel, float depth, OwnDeposit own) {
    float start = texelFetch(t_start, texel, 0).x;
    if (!(depth > start)) return 0.0;
    float end = texelFetch(t_end, texel, 0).x;
    if (depth >= end) return plane_optical_depth(texel, u_layers) - own.optical_depth;
    float x = between(start, end, depth);
    int layer = layer_of(x);
    float along = (x - u_planes[layer]) / (u_planes[layer + 1] - u_planes[layer]);
    float before = plane_optical_depth(texel, layer), behind = plane_optical_depth(texel, layer + 1);
    float own_part = counted(between(start, end, own.depth), between(start, end, own.depth_end), layer, along);
    return mix(before, behind, along) - own.optical_depth * own_part;
}

#include "lib/lookup.glsl"
#endif
