// The layers of lib/layers.glsl by a scatter: what lies in a layer is added to that layer alone, in
// fixed point, so that sums are exact and in any order the same; then each plane gets the sum of the
// layers before it. C++: techniques/scattered_layers.cpp.

// Layer j of 0 .. K-1 sums in image j, and optical depth times position in image K + j. What does not
// fit into 32 bits is carried; until a carry is needed there is but one texel for all of them.
layout(r32ui) uniform uimage2DArray i_sums, i_carries;
uniform float u_fixed_point;  // units in an optical depth of 1

const float carry_units = 4294967296.0;

#if defined(STRANDS) || defined(MESH) || defined(PARTICLES) || defined(VOLUME)
#include "lib/deposit.glsl"

void add(ivec3 place, float value) {
    float units = floor(value * u_fixed_point + 0.5);
    if (!(units > 0.0)) return;
    float whole = floor(units / carry_units);
    uint rest = uint(units - whole * carry_units);
    uint carry = uint(whole);
    if (imageAtomicAdd(i_sums, place, rest) > ~rest) ++carry;
    if (carry > 0u) imageAtomicAdd(i_carries, min(place, imageSize(i_carries) - 1), carry);
}

void add_to_layer(ivec2 texel, int layer, float optical_depth, float moment) {
    add(ivec3(texel, layer), optical_depth);
#ifdef MEAN_DEPTHS
    add(ivec3(texel, u_layers + layer), moment);
#endif
}

bool is_wanted(ivec2 texel) { return is_sampled(texel); }

// A point lies in one layer, an interval in part in several.
void scatter(ivec2 texel, Deposit deposit) {
    TexelLayers layers = texel_layers(texel);
    float optical_depth = deposit.optical_depth * counted_part(layers, deposit.depth, deposit.depth_end);
    float first = position(layers, deposit.depth), last = position(layers, deposit.depth_end);
    int layer = layer_of(layers.curve, first);
    if (!(last > first)) {
        add_to_layer(texel, layer, optical_depth, optical_depth * first);
        return;
    }
    float before = 0.0, moment_before = 0.0;
    for (; layer < u_layers && before < 1.0; ++layer) {
        float part = counted_at(layers.curve, layer + 1, first, last);
        float moment = part * mean_in_front(layers.curve, layer + 1, first, last);
        add_to_layer(texel, layer, optical_depth * (part - before), optical_depth * (moment - moment_before));
        before = part, moment_before = moment;
    }
}

#include "lib/scatter.glsl"
#else
#include "lib/invocation.glsl"

layout(rgba32f) writeonly uniform image2DArray PLANES;
#ifdef MEAN_DEPTHS
layout(rgba32f) writeonly uniform image2DArray i_moments;
#endif

uniform bool u_carries;  // whether there are any

// In units, of 64 bits.
struct FixedPoint {
    uint carries, rest;
};

void include_layer(inout FixedPoint sum, ivec3 place) {
    uint rest = imageLoad(i_sums, place).x;
    sum.rest += rest;
    if (sum.rest < rest) ++sum.carries;
    if (u_carries) sum.carries += imageLoad(i_carries, place).x;
}

float value_of(FixedPoint sum) {
    return (carry_units / u_fixed_point) * float(sum.carries) + float(sum.rest) / u_fixed_point;
}

// How many of a texel's layers may hold something.
int filled_layers(ivec2 texel) {
#ifdef ENDS_AT_LAST_CASTER
    TexelLayers layers = texel_layers(texel);
    if (layers.start == 1.0 && layers.end == 0.0) return 0;  // as maps without casters are filled
#endif
    return u_layers;
}

// The planes of one image after the other. Behind the last plane nothing is added.
void main() {
    ivec3 size = imageSize(PLANES);
    int index = int(invocation_index());
    ivec2 texel = ivec2(index % size.x, index / size.x);
    if (texel.y >= size.y) return;
    FixedPoint sum = FixedPoint(0u, 0u), moments = FixedPoint(0u, 0u);
    int counted = 0, filled = filled_layers(texel);
    for (int target = 0; target < size.z; ++target) {
        ivec4 planes = planes_of(target);
        vec4 sums, moment_sums;
        for (int i = 0; i < 4; ++i) {
            for (; counted < min(planes[i], filled); ++counted) {
                include_layer(sum, ivec3(texel, counted));
#ifdef MEAN_DEPTHS
                include_layer(moments, ivec3(texel, u_layers + counted));
#endif
            }
            sums[i] = value_of(sum), moment_sums[i] = value_of(moments);
        }
#ifdef PACKED
        if (target == 0) sums.a = texel_layers(texel).start;
#endif
        imageStore(PLANES, ivec3(texel, target), sums);
#ifdef MEAN_DEPTHS
        imageStore(i_moments, ivec3(texel, target), moment_sums);
#endif
    }
}
#endif
