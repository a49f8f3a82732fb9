// Opacity layers: in each texel K planes, with the optical depth in front of each. Here are the pass
// that deposits casters at them, and the look-up. Include it after a technique has said where a texel
// lays its planes, as lib/layer_span.glsl does for layers between two depths:
//     struct TexelLayers, with the start and the end of a texel's layers in light space, and the curve
//     of their planes
//     float position(TexelLayers layers, float depth), among these planes
//     TexelLayers texel_layers(ivec2 texel)
// C++: techniques/layers_on_cpu.cpp.
#include "lib/interval.glsl"
#include "lib/layer_held.glsl"
#include "lib/layer_map.glsl"
#include "lib/planes.glsl"

// With BEYOND_ignore what lies behind the last layer casts nothing.
float counted_part(TexelLayers layers, float begin, float end) {
#ifdef BEYOND_ignore
    if (!(end > begin)) return begin > layers.end ? 0.0 : 1.0;
    return part_in_front(begin, end, layers.end);
#else
    return 1.0;
#endif
}

#ifdef PASS_opacity
// Blocks that a search of planes looks at, since rasterisers skip those that are discarded whole.
#include "lib/block_sample.glsl"

#ifdef SCATTERED
#include "lib/scattered_layers.glsl"
#else
#include "lib/deposit.glsl"

#ifdef WRITES_PLANES
layout(location = 0) out vec4 o_planes[TARGETS];
#define FIRST_MOMENTS TARGETS
#else
#define FIRST_MOMENTS 0
#endif
#ifdef WRITES_MOMENTS
layout(location = FIRST_MOMENTS) out vec4 o_moments[TARGETS];
#endif

// A point counts at every plane behind its own layer, an interval in part at those inside it.
void main() {
    ivec2 texel = ivec2(gl_FragCoord.xy);
    if (!is_sampled(texel)) discard;
    Deposit deposit = deposit_or_discard();
    TexelLayers layers = texel_layers(texel);
    float optical_depth = deposit.optical_depth * counted_part(layers, deposit.depth, deposit.depth_end);
    float first = position(layers, deposit.depth), last = position(layers, deposit.depth_end);
    int layer = layer_of(layers.curve, first);
    for (int target = 0; target < TARGETS; ++target) {
        ivec4 planes = planes_of(FIRST_TARGET + target);
        vec4 part = vec4(greaterThan(planes, ivec4(layer)));
        if (last > first)
            for (int i = 0; i < 4; ++i) part[i] = counted_at(layers.curve, planes[i], first, last);
#ifdef WRITES_PLANES
        vec4 value = stored(optical_depth * part);
#ifdef PACKED
        if (FIRST_TARGET + target == 0) value.a = layers.start;  // of equals the largest remains
#endif
        o_planes[target] = value;
#endif
#ifdef WRITES_MOMENTS
        for (int i = 0; i < 4; ++i) part[i] *= mean_in_front(layers.curve, planes[i], first, last);
        o_moments[target] = optical_depth * part;
#endif
    }
}
#endif
#else

#include "lib/receiver.glsl"

#if defined(CUBIC)
#include "lib/monotone_cubic.glsl"

// Between planes `layer` and layer + 1, through their neighbours. The receiver's own part is taken out
// of all four planes first.
float between_planes(ivec2 texel, int curve, int layer, float x, vec3 own) {
    vec4 places, values;
    for (int i = 0; i < 4; ++i) {
        int k = clamp(layer + i - 1, 0, u_layers);
        places[i] = plane(curve, k) + float(layer + i - 1 - k);  // outside, all stays as it is
        values[i] = plane_optical_depth(texel, k) - own.z * counted_at(curve, k, own.x, own.y);
    }
    return monotone_cubic(places, values, x);
}
#elif defined(MEAN_DEPTHS)
float between_planes(ivec2 texel, int curve, int layer, float x, vec3 own) {
    vec2 sums[2];  // optical depth, and times position, in front of either plane
    for (int i = 0; i < 2; ++i) {
        int k = layer + i;
        float own_part = own.z * counted_at(curve, k, own.x, own.y);
        sums[i] = vec2(plane_optical_depth(texel, k) - own_part,
                       plane_moment(texel, k) - own_part * mean_in_front(curve, k, own.x, own.y));
    }
    vec2 held = sums[1] - sums[0];
    return sums[0].x + held_in_front(held, plane(curve, layer), plane(curve, layer + 1), x);
}
#else
// Optical depth grows evenly from one plane to the next.
float between_planes(ivec2 texel, int curve, int layer, float x, vec3 own) {
    float low = plane(curve, layer), along = (x - low) / (plane(curve, layer + 1) - low);
    float before = plane_optical_depth(texel, layer), behind = plane_optical_depth(texel, layer + 1);
    return rising_line(before, behind, along) - own.z * counted(curve, own.x, own.y, layer, along);
}
#endif

float texel_optical_depth(ivec2 texel, float depth, OwnDeposit own) {
    TexelLayers layers = texel_layers(texel);
    if (!(depth > layers.start)) return 0.0;
    own.optical_depth *= counted_part(layers, own.depth, own.depth_end);
    float x = position(layers, depth);
    int layer = layer_of(layers.curve, x);
    float in_front = own_in_front(own, depth);
    if (in_front > 0.0) in_front = min(in_front, plane_optical_depth(texel, layer + 1));
    if (depth >= layers.end) {
        float all = plane_optical_depth(texel, u_layers);
#ifdef ENDS_AT_LAST_CASTER
        return all;  // in front, the receiver's own too
#else
        return all - own.optical_depth + in_front;
#endif
    }
    vec3 own_part = vec3(position(layers, own.depth), position(layers, own.depth_end), own.optical_depth);
    return between_planes(texel, layers.curve, layer, x, own_part) + in_front;
}

#include "lib/lookup.glsl"
#endif
