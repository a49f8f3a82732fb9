// Light times what the maps let through.
#include "technique.glsl"
#include "lib/lamp.glsl"
#include "lib/shading.glsl"

in vec3 v_p_vs, v_p_ls, v_color;
in vec3 v_axis_vs;

uniform bool u_receives;
uniform float u_receiver_width;  // world units: a strand does not shadow its own neighbourhood
#ifdef MESH
uniform bool u_opaque;
#endif

layout(location = 0) out vec4 o_color;

#ifdef OWN_CORRECTION
in float v_own_opacity;
#ifdef STRANDS
flat in vec3 v_own_direction;
in float v_own_width_texels;
in vec2 v_own_ends;
#endif
#endif

Receiver receiver() {
    Receiver receiver = point_receiver(v_p_ls, u_receiver_width);
#ifdef STRANDS
    receiver.on_strand = true;
#endif
#ifdef OWN_CORRECTION
    receiver.opacity = v_own_opacity;
#ifdef STRANDS
    receiver.width_texels = v_own_width_texels;
    receiver.direction = v_own_direction;
    receiver.ends = v_own_ends;
#endif
#endif
#ifdef MESH
    receiver.direction = surface_direction(dFdx(v_p_ls), dFdy(v_p_ls));
#endif
    return receiver;
}

// What arrives, shadowed. What gets no light needs no look-up.
vec3 shadowed(Arriving arriving, bool faces_light, Receiver receiver) {
    if (!faces_light || arriving.light == vec3(0.0)) return vec3(0.0);
    return u_receives ? shadow_transmittance(receiver) * arriving.light : arriving.light;
}

void main() {
    vec3 axis = v_axis_vs * inversesqrt(max(dot(v_axis_vs, v_axis_vs), 1e-30));
    vec3 to_eye = normalize(-v_p_vs);
    Arriving arriving = arriving_at(v_p_vs);
    Receiver asked = receiver();  // of derivatives: in no branch
#ifdef STRANDS
    vec3 light = shadowed(arriving, true, asked);
    vec3 color = shade_strand(v_color, axis, arriving.to_light, to_eye, light);
#else
    // Real meshes have holes: whoever looks through one sees the inside lit as an inside.
    vec3 normal = dot(axis, to_eye) < 0.0 ? -axis : axis;
    vec3 light = shadowed(arriving, !u_opaque || dot(normal, arriving.to_light) > 0.0, asked);
    vec3 color = u_opaque ? shade_surface(v_color, normal, arriving.to_light, to_eye, light)
                          : shade_translucent(v_color, light);
#endif
    o_color = vec4(color, 1.0);
}
