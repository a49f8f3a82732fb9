// A surface in a texel: a point in depth. An alpha map says how much of the texel it covers.
#include "lib/surface.glsl"
#ifdef ALPHA_MAP
#include "lib/alpha.glsl"

in vec2 v_uv;
#endif

#ifdef LIGHT_FACES
in vec3 v_q;
float depth_here() { return depth_by(drawn_face(), v_q); }
float texels_per_unit() { return texels_per_unit_by(drawn_face(), seen_by(drawn_face(), v_q).z); }
vec2 slope_here() {
    return surface_slope(place_change_by(drawn_face(), v_q, dFdx(v_q)), place_change_by(drawn_face(), v_q, dFdy(v_q)));
}
#else
in float v_depth;
float depth_here() { return v_depth; }
float texels_per_unit() { return drawn_texels_per_unit(); }
vec2 slope_here() { return vec2(dFdx(v_depth), dFdy(v_depth)); }
#endif
#ifdef OPTICAL_DEPTH
in float v_opacity;
#endif

bool covers(out Deposit deposit) {
    deposit.depth = depth_here();
#ifdef MOVED_BACK
    deposit.depth += surface_margin(slope_here(), texels_per_unit());
#endif
    deposit.depth_end = deposit.depth;
    deposit.optical_depth = 0.0;
    float coverage = 1.0;
#ifdef ALPHA_MAP
    coverage = coverage_at(v_uv, coverage_level(dFdx(v_uv), dFdy(v_uv)));
    if (!(coverage > 0.0)) return false;
#endif
#ifdef OPTICAL_DEPTH
    deposit.optical_depth = optical_depth_of(v_opacity * coverage);
#endif
    return true;
}
