// Every texel that a segment's ribbon touches, column by column.
#include "casters/strands.glsl"

// From the first row to behind the last one.
ivec2 rows_in(RibbonColumn ribbon) {
#ifdef PAPER_DEPOSIT
    vec2 rows = floor(ribbon.y) + vec2(-1.0, 2.0);  // the line's own, however it is rounded
#else
    if (!(ribbon.along > 0.0)) return ivec2(0);
    vec2 rows = vec2(floor(ribbon.y - ribbon.half_width), floor(ribbon.y + ribbon.half_width) + 1.0);
#endif
    return ivec2(on_face(rows));
}

// One loop, not two: of casters side by side none waits for another at the end of a column.
void visit_caster(int segment) {
    if (!place_segment(segment)) return;
    visited_segment = major_segment(v_root, v_tip);
    ivec2 columns = ivec2(on_face(columns_of(visited_segment)));
    int column = columns.x - 1;
    ivec2 rows = ivec2(0);
    while (true) {
        if (rows.x >= rows.y) {
            if (++column >= columns.y) break;
            visited_column = ribbon_column(visited_segment, v_width_texels, float(column) + 0.5);
            rows = rows_in(visited_column);
        }
        if (rows.x < rows.y) visit_texel(visited_segment.steep ? ivec2(rows.x, column) : ivec2(column, rows.x));
        ++rows.x;
    }
}
