// The opacity of a shape's vertices, and what of it the opacity maps hold.
layout(std430) readonly buffer b_opacity { float opacity[]; };
uniform int u_opacity_stride;  // 0: one opacity for all

float vertex_opacity(int vertex) { return opacity[vertex * u_opacity_stride]; }

#ifdef OWN_CORRECTION
uniform bool u_deposits;  // whether the opacity maps hold it
float own_opacity(int vertex) { return u_deposits ? vertex_opacity(vertex) : 0.0; }
#endif
