// Every texel that a segment's ribbon touches, column by column.
#include "casters/strands.glsl"

// From the first row to behind the last one of a column.
ivec2 rows_in(Band band, int column) {
    float y = line_at(band, float(column) + 0.5);
    return ivec2(on_face(vec2(floor(y - band.half_width), floor(y + band.half_width) + 1.0)));
}

// One loop, not two: of casters side by side none waits for another at the end of a column.
void visit_caster(int segment) {
    if (!place_segment(segment)) return;
    Band band = placed_band();
    ivec2 columns = ivec2(on_face(band.columns));
    int column = columns.x - 1;
    ivec2 rows = ivec2(0);
    while (true) {
        if (rows.x >= rows.y) {
            if (++column >= columns.y) break;
            rows = rows_in(band, column);
        }
        if (rows.x < rows.y) visit_texel(band.steep ? ivec2(rows.x, column) : ivec2(column, rows.x));
        ++rows.x;
    }
}
