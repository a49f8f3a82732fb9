// A surface in a texel: a point in depth. An alpha map says how much of the texel it covers.
#include "lib/surface.glsl"
#ifdef ALPHA_MAP
#include "lib/alpha.glsl"

in vec2 v_uv;
#endif

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
