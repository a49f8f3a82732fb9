// The layers of lib/layers.glsl by a scatter: what lies in a layer is added to that layer alone, in
// fixed point, so that sums are exact and in any order the same; then each plane gets the sum of the
// layers before it, in its place. C++: techniques/scattered_layers.cpp.

// Maps of floats, an image a plane, seen as their bits: at first of what lies in the layer that the
// plane ends, in units. For a search they hold but the blocks that it looks at, side by side.
layout(r32ui) uniform uimage2DArray PLANES;
#ifdef MEAN_DEPTHS
layout(r32ui) uniform uimage2DArray i_moments;
#endif
// What does not fit into 32 bits, image by image, first of the planes; until a carry is needed there is
// but one texel for all of them.
layout(r32ui) uniform uimage2DArray i_carries;
uniform float u_fixed_point;  // units in an optical depth of 1

const float carry_units = 4294967296.0;

#if defined(STRANDS) || defined(MESH) || defined(PARTICLES) || defined(VOLUME)
#include "lib/deposit.glsl"

// In units: what 32 bits hold of them, and carries.
uvec2 fixed_point(float value) {
    float units = floor(value * u_fixed_point + 0.5);
    if (!(units > 0.0)) return uvec2(0u);
    float whole = floor(units / carry_units);
    return uvec2(uint(units - whole * carry_units), uint(whole));
}

void carry(ivec3 place, uint carries) {
    if (carries > 0u) imageAtomicAdd(i_carries, min(place, imageSize(i_carries) - 1), carries);
}

void add_to_layer(ivec2 texel, int layer, float optical_depth, float moment) {
    ivec3 place = ivec3(packed_place(texel), slot_of(layer + 1));
    uvec2 units = fixed_point(optical_depth);
    if (imageAtomicAdd(PLANES, place, units.x) > ~units.x) ++units.y;
    carry(place, units.y);
#ifdef MEAN_DEPTHS
    units = fixed_point(moment);
    if (imageAtomicAdd(i_moments, place, units.x) > ~units.x) ++units.y;
    carry(place + ivec3(0, 0, imageSize(PLANES).z), units.y);
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

uniform bool u_carries;  // whether there are any

// In units, of 64 bits.
struct FixedPoint {
    uint rest, carries;
};

void include_layer(inout FixedPoint sum, uint rest, ivec3 place) {
    sum.rest += rest;
    if (sum.rest < rest) ++sum.carries;
    if (u_carries) sum.carries += imageLoad(i_carries, place).x;
}

// As a float's bits: all 0 where there is nothing.
uvec4 bits_of(FixedPoint sum) {
    float value = (carry_units / u_fixed_point) * float(sum.carries) + float(sum.rest) / u_fixed_point;
    return uvec4(floatBitsToUint(value));
}

// No caster has come into it, so that its bounds and all of its planes are as they were filled. Mirrored
// bounds of a single caster may end before they start, by rounding.
bool is_empty(TexelLayers layers) {
#ifdef ENDS_AT_LAST_CASTER
    return layers.start == 1.0 && layers.end == 0.0;
#else
    return false;
#endif
}

void main() {
    ivec2 size = imageSize(PLANES).xy;
    int index = int(invocation_index());
    ivec2 texel = ivec2(index % size.x, index / size.x);
    if (texel.y >= size.y) return;
    TexelLayers layers = texel_layers(unpacked_texel(texel));
    if (is_empty(layers)) return;
    FixedPoint sum = FixedPoint(0u, 0u), moments = FixedPoint(0u, 0u);
    for (int k = 1; k <= u_layers; ++k) {
        ivec3 place = ivec3(texel, slot_of(k));
        include_layer(sum, imageLoad(PLANES, place).x, place);
        imageStore(PLANES, place, bits_of(sum));
#ifdef MEAN_DEPTHS
        include_layer(moments, imageLoad(i_moments, place).x, place + ivec3(0, 0, imageSize(PLANES).z));
        imageStore(i_moments, place, bits_of(moments));
#endif
    }
#ifdef PACKED
    imageStore(PLANES, ivec3(texel, start_slot), uvec4(floatBitsToUint(layers.start)));
#endif
}
#endif
