// One segment of a strand, pulled from the shape's buffers by every corner of its ribbon: two triangles, six vertices.

layout(std430) readonly buffer b_points { vec4 points[]; };        // xyz in the shape's units, w the strand's width
layout(std430) readonly buffer b_segments { uint segments[]; };    // index of each segment's first point

int segment_index() { return gl_VertexID / 6; }

// (0 or 1 along the strand, -1 or 1 across it)
vec2 segment_corner() {
    int corner = gl_VertexID % 6;
    float along = corner == 1 || corner == 2 || corner == 4 ? 1.0 : 0.0;
    float across = corner == 2 || corner == 4 || corner == 5 ? 1.0 : -1.0;
    return vec2(along, across);
}
