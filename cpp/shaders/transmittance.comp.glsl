// The fraction of light that reaches each of a list of points.
#include "lib/invocation.glsl"
#include "technique.glsl"

layout(std430) readonly buffer b_points_ls { vec4 points_ls[]; };
layout(std430) writeonly buffer b_transmittance { float transmittance[]; };
uniform int u_point_count;

void main() {
    uint index = invocation_index();
    if (index < uint(u_point_count)) transmittance[index] = shadow_transmittance(points_ls[index].xyz);
}
