// The opacity of a shape's vertices.
layout(std430) readonly buffer b_opacity { float opacity[]; };
uniform int u_opacity_stride;  // 0: one opacity for all

float vertex_opacity(int vertex) { return opacity[vertex * u_opacity_stride]; }

