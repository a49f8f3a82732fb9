// T along strands, at places some texels of the light's map apart: one invocation a segment. C++:
// render/strand_shadows.hpp.
#include "lib/own_correction.glsl"
#include "lib/invocation.glsl"
#include "technique.glsl"
#include "lib/segment.glsl"

uniform mat4 u_light_from_local;
uniform float u_width_scale;
uniform float u_receiver_width;  // world units
uniform int u_shape_index;
// A range of the segments, neighbours in space one after the other: they read the same texels.
uniform int u_quad_first, u_quad_count;
layout(std430) readonly buffer b_casters { uint casters[]; };

#ifdef OWN_CORRECTION
#include "lib/light.glsl"
#include "lib/ribbon.glsl"
#include "lib/vertex_opacity.glsl"
#include "lib/strand_end.glsl"
#endif

// Of each shape: its first place, and the steps from one end of a segment to the other.
layout(std430) readonly buffer b_places { ivec2 places[]; };
layout(std430) writeonly buffer b_strand_transmittance { float strand_transmittance[]; };

void main() {
    int quad = int(invocation_index());
    if (quad >= u_quad_count) return;
    int segment = int(casters[u_quad_first + quad]);
    int root = int(segments[segment]);
    vec3 p_root = (u_light_from_local * vec4(points[root].xyz, 1.0)).xyz;
    vec3 p_tip = (u_light_from_local * vec4(points[root + 1].xyz, 1.0)).xyz;
#ifdef OWN_CORRECTION
    StrandEnd at_root = strand_end(segment, false), at_tip = strand_end(segment, true);
#endif
    int steps = places[u_shape_index].y;
    int first = places[u_shape_index].x + segment * (steps + 1);
    for (int i = 0; i <= steps; ++i) {
        float along = float(i) / float(steps);
        Receiver receiver = point_receiver(mix(p_root, p_tip, along), u_receiver_width);
        receiver.on_strand = true;
#ifdef OWN_CORRECTION
        receiver.direction = at_root.direction;
        receiver.ends = mix(at_root.ends, at_tip.ends, along);
        receiver.width_texels = mix(at_root.width_texels, at_tip.width_texels, along);
        receiver.opacity = mix(at_root.opacity, at_tip.opacity, along);
#endif
        strand_transmittance[first + i] = shadow_transmittance(receiver);
    }
}
