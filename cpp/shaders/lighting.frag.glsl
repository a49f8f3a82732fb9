// What the camera sees of a shape: light times what the maps let through, in one sample, or in
// several along a ray through a medium.
#include "technique.glsl"
#include "lib/lamp.glsl"
#include "lib/samples.glsl"
#include "lib/shading.glsl"

in vec3 v_p_vs, v_p_ls, v_color;
in vec3 v_axis_vs;

uniform bool u_receives;
uniform float u_receiver_width;  // world units: a strand does not shadow its own neighbourhood
uniform float u_shadow_intensity;

// What arrives, shadowed. What gets no light needs no look-up.
vec3 shadowed(Arriving arriving, bool faces_light, Receiver receiver) {
    if (!faces_light || arriving.light == vec3(0.0)) return vec3(0.0);
    if (!u_receives) return arriving.light;
    return mix(1.0, shadow_transmittance(receiver), u_shadow_intensity) * arriving.light;
}

#if defined(PARTICLES)
#include "lighting/particles.frag.glsl"
#elif defined(VOLUME)
#include "lighting/volume.frag.glsl"
#else
#include "lighting/surface.frag.glsl"
#endif
