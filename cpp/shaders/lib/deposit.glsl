// The deposit rule (docs/accuracy.md): which optical depth a fragment adds, and at which depth. It
// does not depend on the map's resolution: a strand of opacity o that covers the part c of a texel
// lets 1 - o c through, over the part f of the column that the segment spans.
#include "lib/light.glsl"
#include "lib/opacity.glsl"
#ifdef STRANDS
#include "lib/ribbon.glsl"
#endif

#ifdef READS_OPAQUE_DEPTH
uniform sampler2D t_opaque_depth;
#endif

struct Deposit {
    float depth;          // light space
    float optical_depth;  // 0 unless OPTICAL_DEPTH
};

#ifdef STRANDS
flat in vec3 v_root, v_tip;
flat in vec2 v_width_texels;
#ifdef OPTICAL_DEPTH
flat in vec2 v_opacity;
#endif

bool covers(out Deposit deposit) {
    deposit = Deposit(0.0, 0.0);
    Coverage coverage;
#ifdef PAPER_DEPOSIT
    if (!line_coverage(v_root, v_tip, gl_FragCoord.xy, coverage)) return false;
#else
    if (!ribbon_coverage(v_root, v_tip, v_width_texels, gl_FragCoord.xy, coverage)) return false;
#endif
    deposit.depth = coverage.depth;
#ifdef OPTICAL_DEPTH
    float opacity = mix(v_opacity.x, v_opacity.y, coverage.place);
    deposit.optical_depth = coverage.along * optical_depth_of(opacity * coverage.across);
#endif
    return true;
}
#endif

#ifdef MESH
#include "lib/surface.glsl"

in float v_depth;
#ifdef LIGHT_FACES
flat in int v_face;
in float v_forward;
float texels_per_unit() { return texels_per_unit_by(v_face, v_forward); }
#else
float texels_per_unit() { return u_light_texels_per_unit; }
#endif
#ifdef OPTICAL_DEPTH
in float v_opacity;
#endif

bool covers(out Deposit deposit) {
    deposit.depth = v_depth;
#ifndef AT_SURFACE
    deposit.depth += surface_margin(vec2(dFdx(v_depth), dFdy(v_depth)), texels_per_unit());
#endif
    deposit.optical_depth = 0.0;
#ifdef OPTICAL_DEPTH
    deposit.optical_depth = optical_depth_of(v_opacity);
#endif
    return true;
}
#endif

// The fragment's deposit. Discards what no receiver can notice: texels that are not covered, and
// casters behind all receivers or behind an opaque one, where T is 0 without them.
Deposit deposit_or_discard() {
    Deposit deposit = Deposit(0.0, 0.0);
    if (!covers(deposit)) discard;
    deposit.depth = max(deposit.depth, 0.0);
    if (!(deposit.depth <= 1.0)) discard;
#ifdef READS_OPAQUE_DEPTH
    if (deposit.depth > texelFetch(t_opaque_depth, ivec2(gl_FragCoord.xy), 0).x) discard;
#endif
    return deposit;
}
