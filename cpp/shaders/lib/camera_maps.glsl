// How much of a sample the camera sees past what is translucent before it, by maps that are a
// light's but for where they are drawn from (render/camera_maps.hpp).
#include "camera/technique.glsl"

// Every sample counts for something, so that a pixel of few has a colour whatever the maps say.
const float least_seen = 1e-20;

float camera_transmittance(vec3 p_vs, float opacity) {
    vec3 q = vec3(p_vs.x, -p_vs.yz) / u_camera_light_depth_range;
    camera_Receiver receiver = camera_point_receiver(q, 0.0);
#ifdef MESH
    receiver.opacity = opacity;
    receiver.on_surface = true;
    receiver.direction = camera_surface_direction(dFdx(q), dFdy(q));
#endif
    return max(camera_shadow_transmittance(receiver), least_seen);
}
