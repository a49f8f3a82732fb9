// The fraction of light that reaches each of a list of receivers.
#include "lib/invocation.glsl"
#include "technique.glsl"

// Four floats a vector, in the order of map/receiver.hpp.
struct Query {
    vec4 p_ls;  // w: width_texels
    vec4 direction;  // w: opacity
    vec4 ends;  // z: 1 on a strand, 2 on a surface; w: own_reach
};
layout(std430) readonly buffer b_query { Query queries[]; };
layout(std430) writeonly buffer b_transmittance { float transmittance[]; };
uniform int u_receiver_first, u_receiver_count;
uniform float u_receiver_width;  // world units

void main() {
    uint index = invocation_index();
    if (index >= uint(u_receiver_count)) return;
    index += uint(u_receiver_first);
    Query query = queries[index];
    Receiver receiver = point_receiver(query.p_ls.xyz, u_receiver_width);
    receiver.opacity = query.direction.w;
    receiver.width_texels = query.p_ls.w;
    receiver.direction = query.direction.xyz;
    receiver.ends = query.ends.xy;
    receiver.on_strand = query.ends.z == 1.0;
    receiver.on_surface = query.ends.z == 2.0;
    receiver.own_reach = query.ends.w;
    transmittance[index] = shadow_transmittance(receiver);
}
