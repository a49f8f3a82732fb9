// Maps whose texels keep COEFFICIENTS sums over their casters, each of optical depth times a function
// of where it lies. Sums add up in any order, and their means over texels are those of the casters'
// density. Here are the pass that sums them, and the look-up. Include it after lib/layer_span.glsl,
// TexelLayers texel_layers(ivec2 texel), and what the sums are and tell; k is 0, 1, 2 .. in turn:
//     struct Means, Means caster_means(float begin, float end), float next_mean(inout Means, int k)
//         what a caster of optical depth 1 adds to each
//     struct Sums, Sums sums_at(float x), void add(inout Sums sums, int k, float c)
//     float whole_optical_depth(Sums sums)   of all casters
//     float optical_depth_before(Sums sums, float all)  of those in front of x, or about; `all`: of
//         the texel, with what was taken out
// Places are positions among the texel's layers, 0 .. 1. C++: techniques/coefficients_on_cpu.cpp,
// map/expansion.hpp.

#ifdef PASS_coefficients
#include "lib/deposit.glsl"

layout(location = 0) out vec4 o_coefficients[TARGETS];

void main() {
    Deposit deposit = deposit_or_discard();
    TexelLayers layers = texel_layers(ivec2(gl_FragCoord.xy));
    float begin = position(layers, deposit.depth);
    Means means = caster_means(begin, deposit_ends > 1 ? position(layers, deposit.depth_end) : begin);
    for (int k = 0; k < 4 * FIRST_TARGET; ++k) next_mean(means, k);  // of the pass before
    for (int target = 0; target < TARGETS; ++target) {
        vec4 value = vec4(0.0);
        for (int i = 0; i < 4; ++i) {
            int k = 4 * (FIRST_TARGET + target) + i;
            if (k < COEFFICIENTS) value[i] = next_mean(means, k);
        }
        o_coefficients[target] = deposit.optical_depth * value;
    }
}
#else

#include "lib/receiver.glsl"

uniform sampler2DArray t_coefficients;

// Of the casters but the receiver's own.
Sums sums_of_others(ivec2 texel, TexelLayers layers, float depth, OwnDeposit own) {
    Sums sums = sums_at(position(layers, depth));
    Means mine = caster_means(position(layers, own.depth), position(layers, own.depth_end));
    for (int target = 0; 4 * target < COEFFICIENTS; ++target) {
        vec4 c = texelFetch(t_coefficients, ivec3(texel, target), 0);
        for (int i = 0; i < 4; ++i) {
            int k = 4 * target + i;
            if (k >= COEFFICIENTS) continue;
            if (own.optical_depth > 0.0) c[i] -= own.optical_depth * next_mean(mine, k);
            add(sums, k, c[i]);
        }
    }
    return sums;
}

// Never less than nothing, nor more than of all.
float texel_optical_depth(ivec2 texel, float depth, OwnDeposit own) {
    TexelLayers layers = texel_layers(texel);
    if (!(depth > layers.start)) return 0.0;
    Sums others = sums_of_others(texel, layers, depth, own);
    float of_others = whole_optical_depth(others), all = max(of_others + own.optical_depth, 0.0);
    float before = depth < layers.end ? optical_depth_before(others, all) : of_others;
    return clamp(before, 0.0, all) + min(own_in_front(own, depth), all);
}

#include "lib/lookup.glsl"
#endif
