// Who asks for T: a point in light space, and what it lies on if that casts too. A map of layers
// spreads that caster's own deposit over a layer, so that a look-up inside counts a part of it; and
// a strand that slopes toward the light lies in front of itself within a texel. C++: map/receiver.hpp.
#include "lib/light.glsl"
#include "lib/opacity.glsl"
#include "lib/ribbon.glsl"
#include "lib/surface.glsl"

struct Receiver {
    vec3 p_ls;
    float width;         // world units: a strand does not shadow its own neighbourhood; else 0
    // Its own caster; opacity 0 where it lies on none, or where nothing is to be corrected.
    float opacity;
    float width_texels;  // of its strand; 0 on a surface
    vec3 direction;      // of its strand, one texel long on the major axis; surface: xy = slope
    vec2 ends;           // how far its strand reaches both ways, in directions
    bool on_strand;      // no opaque surface that it lies on can shadow itself
};

// What a texel holds of the receiver's own caster.
struct OwnDeposit {
    float depth;
    float optical_depth;  // 0: nothing
};

const OwnDeposit no_own_deposit = OwnDeposit(0.0, 0.0);

Receiver point_receiver(vec3 p_ls, float width) {
    return Receiver(p_ls, width, 0.0, 0.0, vec3(0.0), vec2(0.0), false);
}

OwnDeposit own_strand_deposit(Receiver receiver, vec2 texel) {
    Coverage coverage;
    vec3 root = receiver.p_ls + receiver.ends.x * receiver.direction;
    vec3 tip = receiver.p_ls + receiver.ends.y * receiver.direction;
    if (!ribbon_coverage(root, tip, vec2(receiver.width_texels), texel, coverage)) return no_own_deposit;
    return OwnDeposit(max(coverage.depth, 0.0),
                      coverage.along * optical_depth_of(receiver.opacity * coverage.across));
}

// Where the surface turns away from the light nothing is known of its neighbourhood.
OwnDeposit own_surface_deposit(Receiver receiver, vec2 texel) {
    vec2 slope = receiver.direction.xy;
    float margin = surface_margin(slope);
    if (margin >= largest_surface_margin()) return no_own_deposit;
    float depth = receiver.p_ls.z + dot(slope, texel - receiver.p_ls.xy) + margin;
    return OwnDeposit(max(depth, 0.0), optical_depth_of(receiver.opacity));
}

// `texel` by its index.
OwnDeposit own_deposit(Receiver receiver, ivec2 texel) {
    if (!(receiver.opacity > 0.0)) return no_own_deposit;
    vec2 middle = vec2(texel) + 0.5;
    return receiver.width_texels > 0.0 ? own_strand_deposit(receiver, middle)
                                       : own_surface_deposit(receiver, middle);
}
