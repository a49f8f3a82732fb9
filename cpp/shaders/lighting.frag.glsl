// What the camera sees of a shape: light times what the maps let through, in one sample, or in
// several along a ray through a medium.
#include "lib/own_correction.glsl"
#include "technique.glsl"
#include "lib/lamp.glsl"
#include "lib/samples.glsl"
#include "lib/shading.glsl"

in vec3 v_p_vs, v_p_ls, v_color;
in vec3 v_axis_vs;

uniform float u_receiver_width;  // world units: a strand does not shadow its own neighbourhood
uniform float u_shadow_intensity;

#if defined(STRANDS) && defined(ALONG_STRANDS)
layout(std430) readonly buffer b_strand_transmittance { float strand_transmittance[]; };
flat in ivec2 v_strand_place;
in float v_along;

// Between the places along the strand where it was looked up (strand_shadows.comp.glsl).
float transmittance_here(Receiver receiver) {
    float x = clamp(v_along, 0.0, 1.0) * float(v_strand_place.y);
    int step = min(int(x), v_strand_place.y - 1), place = v_strand_place.x + step;
    return mix(strand_transmittance[place], strand_transmittance[place + 1], x - float(step));
}
#else
float transmittance_here(Receiver receiver) { return shadow_transmittance(receiver); }
#endif

// What arrives, shadowed. What gets no light needs no look-up.
vec3 shadowed(Arriving arriving, bool faces_light, Receiver receiver) {
    if (!faces_light || arriving.light == vec3(0.0)) return vec3(0.0);
#ifdef RECEIVES
    return mix(1.0, transmittance_here(receiver), u_shadow_intensity) * arriving.light;
#else
    return arriving.light;
#endif
}

#if defined(PARTICLES)
#include "lighting/particles.frag.glsl"
#elif defined(VOLUME)
#include "lighting/volume.frag.glsl"
#else
#include "lighting/surface.frag.glsl"
#endif
