// Quadrilaterals of four vertices each, for shapes that are pulled from buffers.

int quad_index() { return gl_VertexID / 4; }

// (0 or 1, 0 or 1), around the quadrilateral.
vec2 quad_corner() {
    int corner = gl_VertexID % 4;
    return vec2(corner == 1 || corner == 2 ? 1.0 : 0.0, corner < 2 ? 0.0 : 1.0);
}
