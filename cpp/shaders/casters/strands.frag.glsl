// A strand's ribbon in a texel: a point in depth.
#include "casters/strands.glsl"

#ifdef LIGHT_FACES
// What is even along the segment is not along its picture on a face.
void put_right(inout Coverage coverage) {
    float s = coverage.place;
    coverage.place = s * v_forward.x / ((1.0 - s) * v_forward.y + s * v_forward.x);
    coverage.depth = depth_by(drawn_face(), mix(v_root_q, v_tip_q, coverage.place));
}
#endif

#ifdef STAGE_COMPUTE
// Told by casters/strands.comp.glsl, once a segment and once a column.
MajorSegment visited_segment;
RibbonColumn visited_column;
#endif

bool covers_texel(out Coverage coverage) {
#ifndef STAGE_COMPUTE
    MajorSegment visited_segment = major_segment(v_root, v_tip);
#endif
#ifdef PAPER_DEPOSIT
    return line_coverage(visited_segment, texel_in_face(), coverage);
#elif defined(STAGE_COMPUTE)
    return row_coverage(visited_column, on_axes(visited_segment, texel_in_face()).y, coverage);
#else
    return ribbon_coverage(visited_segment, v_width_texels, texel_in_face(), coverage);
#endif
}

bool covers(out Deposit deposit) {
    deposit = Deposit(0.0, 0.0, 0.0);
    Coverage coverage;
    if (!covers_texel(coverage)) return false;
#ifdef LIGHT_FACES
    put_right(coverage);
#endif
    deposit.depth = deposit.depth_end = coverage.depth;
#ifdef OPTICAL_DEPTH
    float opacity = mix(v_opacity.x, v_opacity.y, coverage.place);
    deposit.optical_depth = coverage.along * optical_depth_of(opacity * coverage.across);
#endif
    return true;
}
