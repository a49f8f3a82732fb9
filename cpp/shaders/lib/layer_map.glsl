// How opacity layers stand in their map: plane k is channel c of image t where 4 t + c = k - 1, or, by
// a scatter, which takes one channel, image k - 1. With PACKED the fourth place keeps the start of the
// texel's layers, and the planes behind move on by one. C++: techniques/drawn_layers.hpp.
#ifndef PLANES_AN_IMAGE
#define PLANES_AN_IMAGE 4
#endif

#ifdef PACKED
const int start_slot = 3;
int slot_of(int k) { return k > 3 ? k : k - 1; }
ivec4 planes_of(int target) { return 4 * target + (target > 0 ? ivec4(0, 1, 2, 3) : ivec4(1, 2, 3, 4)); }
#else
int slot_of(int k) { return k - 1; }
ivec4 planes_of(int target) { return 4 * target + ivec4(1, 2, 3, 4); }
#endif

// What a channel holds of an optical depth. In 8 bits exp(-u_kappa) = 2^-8, so that a full channel
// lets through what it cannot tell from nothing; rounded here, since drivers round differently.
#ifdef ACCUMULATOR_unorm8
uniform float u_kappa;

vec4 stored(vec4 optical_depth) { return floor(255.0 * min(optical_depth / u_kappa, 1.0) + 0.5) / 255.0; }
float restored(float value) { return u_kappa * min(value, 1.0); }
#else
vec4 stored(vec4 optical_depth) { return optical_depth; }
float restored(float value) { return value; }
#endif

#ifdef SWEEP
// Four planes at a time in one texture, each in the channel that it has in the map.
layout(rgba32f) readonly uniform image2D i_slices;
#elif !defined(PASS_opacity)
uniform sampler2DArray t_opacity;
#ifdef MEAN_DEPTHS
uniform sampler2DArray t_moments;
#endif
#endif

#ifndef PASS_opacity
// Optical depth in front of plane k; nothing is in front of plane 0.
float plane_optical_depth(ivec2 texel, int k) {
    if (k == 0) return 0.0;
    int slot = slot_of(k);
#ifdef SWEEP
    return restored(imageLoad(i_slices, texel)[slot % 4]);
#else
    return restored(texelFetch(t_opacity, ivec3(texel, slot / PLANES_AN_IMAGE), 0)[slot % PLANES_AN_IMAGE]);
#endif
}

#ifdef MEAN_DEPTHS
// The same sum, of optical depth times the position where it lies.
float plane_moment(ivec2 texel, int k) {
    if (k == 0) return 0.0;
    int slot = slot_of(k);
    return texelFetch(t_moments, ivec3(texel, slot / PLANES_AN_IMAGE), 0)[slot % PLANES_AN_IMAGE];
}
#endif
#endif
