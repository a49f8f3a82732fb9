// What every map shares in the look-up: the front test, the opaque depth map, and the filter. By
// default the mean is of T, not of optical depth: it is what a footprint lets through. Include it
// after defining
//     float texel_optical_depth(ivec2 texel, float depth, OwnDeposit own)
// what the translucent casters of one texel have in front of a depth, without the receiver's own
// part of it. C++: map/lookup.hpp.
#include "lib/filter.glsl"
#include "lib/light.glsl"
#include "lib/receiver.glsl"

uniform sampler2D t_opaque_depth;
#ifdef BARE_POINTS
uniform sampler2D t_opaque_moved;  // lib/surface.glsl
#endif
uniform float u_bias;              // world units; negative: automatic
uniform float u_light_least_bias;  // world units

#ifdef SWEEP
uniform vec2 u_slab;                            // from which depth to which
uniform bool u_is_first_slab, u_is_last_slab;  // what lies before, or behind, counts too

// A sweep asks slab by slab, and adds up what it is answered: a tap counts where it lies. Also one
// that is not a number does, once.
bool counts_at(float depth) {
    return (u_is_first_slab || depth >= u_slab.x) && (u_is_last_slab || !(depth >= u_slab.y));
}
#else
bool counts_at(float depth) { return true; }
#endif

// Sums over the taps of a look-up. Weights are divided by their sum, so that T = 1 stays 1 exactly.
struct Taps {
    float weight;
    float lit;            // weight of those that no opaque caster darkens
    float transmittance;  // weight times T
    float optical_depth;  // weight times optical depth
};

// What a curved surface may lie in front of its own plane, in texels.
const float surface_bias_texels = 0.4;

// A surface is looked up along its own plane, so that none of it shadows the rest.
float depth_at(Receiver receiver, ivec2 texel, float depth) {
    if (!receiver.on_surface) return depth;
    vec2 offset = vec2(texel) + 0.5 - receiver.p_ls.xy;
    return depth + plane_change(receiver.direction.xy, offset, receiver.texels_per_unit);
}

float first_opaque(Receiver receiver, ivec2 place) {
#ifdef BARE_POINTS
    if (is_bare(receiver)) return texelFetch(t_opaque_moved, place, 0).x;
#endif
    return texelFetch(t_opaque_depth, place, 0).x;
}

// The neighbours of a triangle may lean twice as much as it does; the mean plane at a vertex, as C++
// has it, is nearer to the surface.
bool is_behind_opaque(Receiver receiver, ivec2 place, float depth) {
    if (receiver.on_triangle) depth -= surface_margin(receiver.direction.xy, receiver.texels_per_unit);
    return first_opaque(receiver, place) < min(depth, 1.0);
}

// World units toward the light within which nothing counts.
float bias_of(Receiver receiver) {
    float bias = u_bias;
    if (u_bias < 0.0) {
        bias = max(receiver.width, u_light_least_bias);
        if (receiver.on_surface) bias = max(bias, surface_bias_texels / receiver.texels_per_unit);
    }
    return max(bias, receiver.own_reach);
}

// A map of up to three texels has no border: its outer texels stand for what lies beside them.
// Elsewhere nothing casts outside.
void add_tap(inout Taps taps, Receiver receiver, MajorSegment own, ivec2 texel, float depth, float weight) {
    if (u_light_map_size_px < 4) texel = clamp(texel, ivec2(0), ivec2(u_light_map_size_px - 1));
    taps.weight += weight;
    depth = depth_at(receiver, texel, depth);
    if (!counts_at(depth)) return;
    float optical_depth = 0.0;
    if (all(greaterThanEqual(texel, ivec2(0))) && all(lessThan(texel, ivec2(u_light_map_size_px)))) {
        ivec2 place = receiver.corner + texel;
        if (is_behind_opaque(receiver, place, depth)) return;
        optical_depth = max(0.0, texel_optical_depth(place, depth, own_deposit(receiver, own, texel)));
    }
    taps.lit += weight;
    taps.transmittance += weight * exp(-optical_depth);
    taps.optical_depth += weight * optical_depth;
}

// None where they are not wanted.
Taps filtered_taps(Receiver receiver, float depth, bool are_wanted) {
    Taps taps = Taps(0.0, 0.0, 0.0, 0.0);
    vec2 p = receiver.p_ls.xy;
    MajorSegment own = own_segment(receiver);
#if defined(FILTER_bilinear)
    // A box of one texel: most look-ups are this. Software goes through a branch that no lane takes, but
    // leaves a loop in which none is left; a GPU waits for one tap after the other where it cannot
    // unroll.
#ifdef SOFTWARE
    int count = are_wanted ? 4 : 0;
#else
    if (!are_wanted) return taps;
    const int count = 4;
#endif
    ivec2 first = ivec2(floor(p - 0.5));
    vec2 of_next = p - 0.5 - vec2(first), of_first = 1.0 - of_next;
    for (int i = 0; i < count; ++i) {
        bvec2 is_next = bvec2(i % 2 == 1, i >= 2);
        float weight = (is_next.x ? of_next.x : of_first.x) * (is_next.y ? of_next.y : of_first.y);
        add_tap(taps, receiver, own, first + ivec2(is_next), depth, weight);
    }
#else
    if (!are_wanted) return taps;
#if defined(FILTER_none)
    add_tap(taps, receiver, own, ivec2(floor(p)), depth, 1.0);
#elif defined(FILTER_pcf)
    // 4 x 4 points (Bunnell and Pellacini 2004; thesis, section 3.5): at a radius of two texels they
    // are neighbours.
    float radius = filter_radius_texels(receiver.texels_per_unit);
    for (int i = 0; i < 16; ++i) {
        vec2 offset = (vec2(i % 4, i / 4) - 1.5) * (0.5 * radius);
        add_tap(taps, receiver, own, ivec2(floor(p + offset)), depth, 1.0 / 16.0);
    }
#else
    float radius = filter_radius_texels(receiver.texels_per_unit);
    ivec2 first = ivec2(floor(p - radius)), last = ivec2(ceil(p + radius)) - 1;
    for (int y = first.y; y <= last.y; ++y) {
        float weight_y = filter_weight(float(y) - p.y, radius);
        for (int x = first.x; x <= last.x; ++x)
            add_tap(taps, receiver, own, ivec2(x, y), depth, weight_y * filter_weight(float(x) - p.x, radius));
    }
#endif
#endif
    return taps;
}

// Through one face of the map.
float face_transmittance(Receiver receiver) {
    float depth = receiver.p_ls.z - bias_of(receiver) / u_light_depth_range;
    // Also false for a coordinate that is not finite: T = 1, never NaN. Not precise, a compiler may turn
    // the comparisons round, and NaN passes.
    float reach = largest_filter_radius + 1.0;
    precise bool is_near = depth > 0.0 && all(greaterThan(receiver.p_ls.xy, vec2(-reach))) &&
                           all(lessThan(receiver.p_ls.xy, vec2(float(u_light_map_size_px) + reach)));
    Taps taps = filtered_taps(receiver, depth, is_near);
    if (!is_near) return counts_at(depth) ? 1.0 : 0.0;
#ifdef DENSITY_FILTER
    // The density interpretation (Jansen and Bavoil 2010, section 6), of what no opaque caster hides.
    if (!(taps.lit > 0.0)) return 0.0;
    return min(taps.lit / taps.weight, 1.0) * exp(-taps.optical_depth / taps.lit);
#else
    return min(taps.transmittance / taps.weight, 1.0);  // a division may round up
#endif
}

#ifdef LIGHT_SPLITS
// By a split: with all that the filter reads.
bool is_held(Receiver receiver) {
    float radius = wanted_radius_texels(receiver.texels_per_unit), reach = radius + 1.0;
    return radius <= largest_filter_radius && all(greaterThan(receiver.p_ls.xy, vec2(reach))) &&
           all(lessThan(receiver.p_ls.xy, vec2(float(u_light_map_size_px) - reach)));
}

int split_of(Receiver receiver) {
    for (int split = 1; split < LIGHT_SPLITS; ++split)
        if (is_held(seen_through(split, receiver))) return split;
    return 0;
}
#endif

float shadow_transmittance(Receiver receiver) {
#ifdef LIGHT_FACES
    // The mean over the light's points. What is beside or behind a face lies in no shadow.
    int eyes = LIGHT_FACES / u_light_faces_an_eye;
    float sum = 0.0;
    for (int eye = 0; eye < eyes; ++eye) {
        int face = face_of(eye, receiver.p_ls);
        bool is_before = seen_by(face, receiver.p_ls).z > least_forward;
        sum += is_before ? face_transmittance(seen_through(face, receiver)) : counts_at(0.0) ? 1.0 : 0.0;
    }
    return min(sum / float(eyes), 1.0);
#elif defined(LIGHT_SPLITS)
    return face_transmittance(seen_through(split_of(receiver), receiver));
#else
    return face_transmittance(receiver);
#endif
}
