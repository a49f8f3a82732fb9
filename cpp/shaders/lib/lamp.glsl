// The light that would arrive at a point of view space without any caster: from where, and how much.

uniform vec3 u_light_color;  // colour times intensity
#ifdef POSITIONAL_LIGHT
uniform vec3 u_light_position_vs;
uniform vec3 u_light_attenuation;  // constant, linear, quadratic in the distance
#ifdef SPOT_LIGHT
uniform vec3 u_light_axis_vs;  // the way it shines
uniform vec2 u_light_cone;     // cosines of the angles to the axis between which it fades in
#endif
#else
uniform vec3 u_to_light_ws;
uniform mat3 u_camera_rotation;  // world to view
#endif

struct Arriving {
    vec3 to_light;  // of length 1, view space
    vec3 light;     // 0 where the light does not shine: T is of no use there
};

// An area light shades from its middle; its shadows come from all of it.
Arriving arriving_at(vec3 p_vs) {
#ifdef POSITIONAL_LIGHT
    vec3 way = u_light_position_vs - p_vs;
    float distance = max(length(way), 1e-30);
    Arriving arriving = Arriving(way / distance, u_light_color);
    arriving.light /= max(dot(u_light_attenuation, vec3(1.0, distance, distance * distance)), 1e-30);
#ifdef SPOT_LIGHT
    arriving.light *= smoothstep(u_light_cone.x, u_light_cone.y, -dot(arriving.to_light, u_light_axis_vs));
#endif
    return arriving;
#else
    return Arriving(u_camera_rotation * u_to_light_ws, u_light_color);
#endif
}
