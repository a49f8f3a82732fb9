// Segments of strands in the shape's buffers; each is pulled by every corner of its ribbon, vertices
// 4 k .. 4 k + 3.

// xyz in the shape's units, w the strand's width there; and the index of each segment's first point.
layout(std430) readonly buffer b_points { vec4 points[]; };
layout(std430) readonly buffer b_segments { uint segments[]; };

#ifdef STAGE_VERTEX
int segment_index() { return gl_VertexID / 4; }

// (0 or 1 along the strand, -1 or 1 across it), around the ribbon.
vec2 segment_corner() {
    int corner = gl_VertexID % 4;
    return vec2(corner == 1 || corner == 2 ? 1.0 : 0.0, corner < 2 ? -1.0 : 1.0);
}
#endif
