// A strand's ribbon in a texel: a point in depth.
#include "lib/ribbon.glsl"

flat in vec3 v_root, v_tip;
flat in vec2 v_width_texels;
#ifdef OPTICAL_DEPTH
flat in vec2 v_opacity;
#endif

bool covers(out Deposit deposit) {
    deposit = Deposit(0.0, 0.0, 0.0);
    Coverage coverage;
#ifdef PAPER_DEPOSIT
    if (!line_coverage(v_root, v_tip, gl_FragCoord.xy, coverage)) return false;
#else
    if (!ribbon_coverage(v_root, v_tip, v_width_texels, gl_FragCoord.xy, coverage)) return false;
#endif
    deposit.depth = deposit.depth_end = coverage.depth;
#ifdef OPTICAL_DEPTH
    float opacity = mix(v_opacity.x, v_opacity.y, coverage.place);
    deposit.optical_depth = coverage.along * optical_depth_of(opacity * coverage.across);
#endif
    return true;
}
