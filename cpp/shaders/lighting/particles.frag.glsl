// The chord of a particle that a ray passes before anything opaque. All of a particle is lit as its
// middle is, its own half of the way to the light left out.
flat in vec3 v_center_vs;
flat in float v_radius;  // view space
in float v_opacity;
uniform int u_profile;  // lib/density_profile.glsl

vec3 shaded(vec3 to_eye) {
    Arriving arriving = arriving_at(v_center_vs);
    vec3 light = shadowed(arriving, true, point_receiver(v_p_ls, v_radius));
    return shade_medium(v_color, arriving.to_light, to_eye, light);
}

void main() {
    vec3 way = normalize(v_p_vs);
    float middle = dot(way, v_center_vs);
    vec3 off = cross(way, v_center_vs);
    float half_squared = v_radius * v_radius - dot(off, off);
    if (!(half_squared > 0.0)) discard;
    float half_chord = sqrt(half_squared);
    float begin = max(middle - half_chord, 0.0), end = min(middle + half_chord, distance_to_solid(way));
    if (!(end > begin)) discard;
    float part = chord_depth_within(u_profile, half_chord / v_radius, (begin - middle) / v_radius,
                                    (end - middle) / v_radius);
    vec3 color = vec3(0.0);
#ifndef COUNTED
    color = shaded(-way);
#endif
    add_sample(color, opacity_of(optical_depth_of(v_opacity) * part), way * (0.5 * (begin + end)));
    write_samples();
}
