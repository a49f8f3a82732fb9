// The deposit rule (docs/accuracy.md): which optical depth a fragment adds, and at which depth. It
// does not depend on the map's resolution: a strand of opacity o that covers the part c of a texel
// lets 1 - o c through, over the part f of the column that the segment spans.
#include "lib/light.glsl"
#include "lib/opacity.glsl"

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

// c is evaluated on the segment's line at the column's centre, so that cutting a segment in two
// changes nothing.
bool covers(out Deposit deposit) {
    vec2 a = v_root.xy, d = v_tip.xy - v_root.xy, texel = gl_FragCoord.xy;
    if (abs(d.y) > abs(d.x)) a = a.yx, d = d.yx, texel = texel.yx;
    precise float f = min(max(a.x, a.x + d.x), texel.x + 0.5) - max(min(a.x, a.x + d.x), texel.x - 0.5);
    if (!(f > 0.0)) return false;
    precise float slope = d.y / d.x;
    precise float along = clamp((texel.x - a.x) / d.x, 0.0, 1.0);
    precise float width = mix(v_width_texels.x, v_width_texels.y, along);
    precise float half_width = 0.5 * width * sqrt(1.0 + slope * slope);
    precise float y = a.y + slope * (texel.x - a.x);
    precise float top = min(y + half_width, texel.y + 0.5);
    precise float c = clamp(top - max(y - half_width, texel.y - 0.5), 0.0, 1.0);
    if (!(c > 0.0)) return false;
    precise float depth = mix(v_root.z, v_tip.z, along);
    deposit.depth = depth;
#ifdef OPTICAL_DEPTH
    deposit.optical_depth = min(f, 1.0) * optical_depth_of(mix(v_opacity.x, v_opacity.y, along) * c);
#endif
    return true;
}
#endif

#ifdef MESH
in float v_depth;
#ifdef OPTICAL_DEPTH
in float v_opacity;
#endif

// A surface is moved away from the light by its own slope over one texel, the reach of the
// look-up's taps, so that no texel shadows its neighbour on the same plane; at silhouettes, where
// the slope is unbounded, by eight texels.
bool covers(out Deposit deposit) {
    float slope = abs(dFdx(v_depth)) + abs(dFdy(v_depth));
    float limit = 8.0 / (u_light_texels_per_unit * u_light_depth_range);
    deposit.depth = v_depth + min(slope, limit);
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
