// A strand's ribbon in a texel: a point in depth.
#include "casters/strands.glsl"
#include "lib/ribbon.glsl"

#ifdef LIGHT_FACES
// What is even along the segment is not along its picture on a face.
void put_right(inout Coverage coverage) {
    float s = coverage.place;
    coverage.place = s * v_forward.x / ((1.0 - s) * v_forward.y + s * v_forward.x);
    coverage.depth = depth_by(drawn_face(), mix(v_root_q, v_tip_q, coverage.place));
}
#endif

bool covers(out Deposit deposit) {
    deposit = Deposit(0.0, 0.0, 0.0);
    Coverage coverage;
#ifdef PAPER_DEPOSIT
    if (!line_coverage(v_root, v_tip, texel_in_face(), coverage)) return false;
#else
    if (!ribbon_coverage(v_root, v_tip, v_width_texels, texel_in_face(), coverage)) return false;
#endif
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
