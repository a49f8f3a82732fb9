// A particle in a texel: an interval, whose depths spread as those of its chords there.
#include "casters/particles.glsl"

uniform int u_profile;  // lib/density_profile.glsl

bool covers(out Deposit deposit) {
    deposit = Deposit(0.0, 0.0, 0.0);
    float through_center = 0.0;
#ifdef OPTICAL_DEPTH
    through_center = optical_depth_of(v_opacity);
#endif
#ifdef LIGHT_FACES
    // A large one by the ray through the texel's middle.
    if (!(v_radius_texels < most_ring_texels)) {
        LightRay ray = light_ray(drawn_face(), texel_in_face());
        float part;
        bool is_met = sphere_chord(ray, v_sphere.xyz, v_sphere.w, u_profile, deposit.depth, deposit.depth_end, part);
        deposit.optical_depth = part * through_center;
        return is_met;
    }
    float depths_a_texel = seen_by(drawn_face(), v_sphere.xyz).z / focal_px(drawn_face());
#else
    float depths_a_texel = 1.0 / (drawn_texels_per_unit() * u_light_depth_range);
#endif
    SphereCoverage coverage;
    if (!sphere_coverage(v_center.xy, v_radius_texels, through_center, u_profile, texel_in_face(), coverage))
        return false;
    float half_length = coverage.half_length * depths_a_texel;
    deposit.depth = v_center.z - half_length;
    deposit.depth_end = v_center.z + half_length;
    deposit.optical_depth = optical_depth_of(coverage.opacity);
    return true;
}
