// The fraction of light that reaches each of a list of points.
#include "technique.glsl"

layout(local_size_x = 64) in;
layout(std430) readonly buffer b_points_ls { vec4 points_ls[]; };
layout(std430) writeonly buffer b_transmittance { float transmittance[]; };
uniform int u_point_count;

void main() {
    uint index = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * 64u + gl_LocalInvocationID.x;
    if (index < uint(u_point_count)) transmittance[index] = shadow_transmittance(points_ls[index].xyz);
}
