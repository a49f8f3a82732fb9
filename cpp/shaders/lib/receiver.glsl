// Who asks for T: a point in light space, and what it lies on if that casts too. A map of layers
// spreads that caster's own deposit over a layer, so that a look-up inside counts a part of it; and
// a strand that slopes toward the light lies in front of itself within a texel. C++: map/receiver.hpp.
#include "lib/light.glsl"
#include "lib/opacity.glsl"
#include "lib/ribbon.glsl"
#include "lib/sphere.glsl"
#include "lib/surface.glsl"

// With LIGHT_FACES a receiver comes in light coordinates, its strand's direction as the whole segment
// there, or its surface's normal, and its width as a directional light would have it; seen_through
// makes of it what one face sees. With LIGHT_SPLITS it comes as it lies in the whole map, and
// seen_through makes of it what one split sees.
struct Receiver {
    vec3 p_ls;
    float width;         // world units: a strand does not shadow its own neighbourhood; else 0
    // Its own caster; opacity 0 where it lies on none, or where nothing is to be corrected.
    float opacity;
    float width_texels;  // of its strand or particle; 0 elsewhere
    // Of its strand, one texel long on the major axis; of a surface xy = slope; of a particle x =
    // its profile (lib/density_profile.glsl).
    vec3 direction;
    vec2 ends;           // how far its strand reaches both ways, in directions
    bool on_strand, on_surface;
    float own_reach;     // world units toward the light: half of its own voxel
    bool on_triangle;    // of an opaque body, the rest of which does not lie on its plane
    ivec2 corner;           // the first texel of the face
    float texels_per_unit;  // 1 / the side of a texel there, in world units
};

// What a texel holds of the receiver's own caster.
struct OwnDeposit {
    float depth, depth_end;
    float optical_depth;  // 0: nothing
};

const OwnDeposit no_own_deposit = OwnDeposit(0.0, 0.0, 0.0);

Receiver point_receiver(vec3 p_ls, float width) {
    return Receiver(p_ls, width, 0.0, 0.0, vec3(0.0), vec2(0.0), false, false, 0.0, false, ivec2(0), u_light_texels_per_unit);
}

bool is_at_particle(Receiver receiver) { return receiver.width_texels > 0.0 && !receiver.on_strand; }

// Of none it is known what it lies on.
bool is_bare(Receiver receiver) {
    return !receiver.on_strand && !receiver.on_surface && receiver.width_texels == 0.0 && receiver.own_reach == 0.0;
}

// Of a surface that two vectors from the receiver span: what `direction` shall be.
vec3 surface_direction(vec3 a, vec3 b) {
#ifdef LIGHT_FACES
    return cross(a, b);
#else
    return vec3(surface_slope(a, b), 0.0);
#endif
}

#ifdef LIGHT_FACES
Receiver seen_through(int face, Receiver receiver) {
    Receiver seen = receiver;
    vec3 q = receiver.p_ls, v = receiver.direction;
    seen.p_ls = place_by(face, q);
    seen.corner = corner_px(face);
    seen.texels_per_unit = texels_per_unit_by(face, seen_by(face, q).z);
    if (receiver.on_strand) {
        vec3 along = place_change_by(face, q, v);
        float texels = max(abs(along.x), abs(along.y));
        seen.direction = texels > 0.0 ? along / texels : vec3(0.0);
        seen.ends = clamp(receiver.ends * texels, -endless_texels, endless_texels);
        float width = receiver.width_texels / (u_light_texels_per_unit * u_light_depth_range);
        seen.width_texels = ribbon_width_by(face, q, v, width);
    } else if (receiver.width_texels > 0.0) {
        seen.width_texels *= seen.texels_per_unit / u_light_texels_per_unit;
    } else if (receiver.on_surface && dot(v, v) > 0.0) {
        vec3 a = cross(v, abs(v.x) < abs(v.y) ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0));
        vec3 b = cross(v, a);
        seen.direction = vec3(surface_slope(place_change_by(face, q, normalize(a)),
                                            place_change_by(face, q, normalize(b))), 0.0);
    }
    return seen;
}
#endif

#ifdef LIGHT_SPLITS
// What changes by texel changes less by one that is finer.
Receiver seen_through(int split, Receiver receiver) {
    Receiver seen = receiver;
    float scale = split_scale(split);
    seen.p_ls = vec3(place_in(split, receiver.p_ls.xy), receiver.p_ls.z);
    seen.corner = corner_px(split);
    seen.texels_per_unit *= scale;
    seen.width_texels *= scale;
    if (receiver.on_surface) seen.direction /= scale;
    if (receiver.on_strand) {
        seen.direction.z /= scale;
        seen.ends = clamp(receiver.ends * scale, -endless_texels, endless_texels);
    }
    return seen;
}
#endif

// What is the same in all texels: the line of its strand; of others it means nothing.
MajorSegment own_segment(Receiver receiver) {
    return major_segment(receiver.p_ls + receiver.ends.x * receiver.direction,
                         receiver.p_ls + receiver.ends.y * receiver.direction);
}

OwnDeposit own_strand_deposit(Receiver receiver, MajorSegment own, vec2 texel) {
    Coverage coverage;
    if (!ribbon_coverage(own, vec2(receiver.width_texels), texel, coverage)) return no_own_deposit;
    float depth = max(coverage.depth, 0.0);
    return OwnDeposit(depth, depth,
                      coverage.along * optical_depth_of(receiver.opacity * coverage.across));
}

// Where the surface turns away from the light nothing is known of its neighbourhood.
OwnDeposit own_surface_deposit(Receiver receiver, vec2 texel) {
    vec2 offset = texel - receiver.p_ls.xy;
    float change = plane_change(receiver.direction.xy, offset, receiver.texels_per_unit);
    if (abs(change) >= plane_limit(offset, receiver.texels_per_unit)) return no_own_deposit;
    float depth = receiver.p_ls.z + change;
    return OwnDeposit(max(depth, 0.0), max(depth, 0.0), optical_depth_of(receiver.opacity));
}

// The one in whose middle it is.
OwnDeposit own_particle_deposit(Receiver receiver, vec2 texel) {
    SphereCoverage coverage;
    if (!sphere_coverage(receiver.p_ls.xy, 0.5 * receiver.width_texels, optical_depth_of(receiver.opacity),
                         int(receiver.direction.x), texel, coverage))
        return no_own_deposit;
    float half_length = coverage.half_length / (receiver.texels_per_unit * u_light_depth_range);
    float begin = max(receiver.p_ls.z - half_length, 0.0);
    float end = max(receiver.p_ls.z + half_length, begin);
    return OwnDeposit(begin, end, optical_depth_of(coverage.opacity));
}

// `texel` by its index in the face, `own` the receiver's own_segment.
OwnDeposit own_deposit(Receiver receiver, MajorSegment own, ivec2 texel) {
    if (!(receiver.opacity > 0.0)) return no_own_deposit;
    vec2 middle = vec2(texel) + 0.5;
    if (is_at_particle(receiver)) return own_particle_deposit(receiver, middle);
    return receiver.width_texels > 0.0 ? own_strand_deposit(receiver, own, middle)
                                       : own_surface_deposit(receiver, middle);
}

// What of it lies in front of a depth, and counts as any other caster does. A particle never does.
float own_in_front(OwnDeposit own, float depth) {
    return own.depth_end > own.depth || own.depth >= depth ? 0.0 : own.optical_depth;
}
