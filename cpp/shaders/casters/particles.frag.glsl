// A particle in a texel: an interval, as long as its mean chord there.
#include "lib/sphere.glsl"

flat in vec3 v_center;
flat in float v_radius_texels;
#ifdef OPTICAL_DEPTH
flat in float v_opacity;
#endif

bool covers(out Deposit deposit) {
    deposit = Deposit(0.0, 0.0, 0.0);
    float through_center = 0.0;
#ifdef OPTICAL_DEPTH
    through_center = optical_depth_of(v_opacity);
#endif
    SphereCoverage coverage;
    if (!sphere_coverage(v_center.xy, v_radius_texels, through_center, gl_FragCoord.xy, coverage)) return false;
    float half_length = coverage.half_length / (u_light_texels_per_unit * u_light_depth_range);
    deposit.depth = v_center.z - half_length;
    deposit.depth_end = v_center.z + half_length;
    deposit.optical_depth = optical_depth_of(coverage.opacity);
    return true;
}
