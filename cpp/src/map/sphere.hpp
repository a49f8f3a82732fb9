// A particle in a texel, by the deposit rule (docs/accuracy.md): the mean opacity over the texel.
// Its disc is cut into rings; each ring's opacity is exact, and the texel gets the angle over which
// the middle of the ring runs inside it. All texels together get all of each ring. GLSL:
// lib/sphere.glsl, in the same order of operations.
#pragma once

#include <optional>

#include "map/face.hpp"
#include "scene/density_profile.hpp"

namespace opacity {

inline constexpr float most_ring_texels = 8.f;  // radius; larger ones are sampled
// A sphere with a larger radius than this part of its distance has no picture of its own on a face.
inline constexpr float near_sphere = 0.25f;

// The interval, and which part of the optical depth through the middle.
struct SphereChord {
    float begin, end, part;
};
// What a ray of light meets of a particle, in light coordinates.
std::optional<SphereChord> sphere_chord(const LightRay& ray, const float3& center, float radius,
                                        DensityProfile profile);

struct SphereCoverage {
    float opacity;      // mean over the texel
    float half_length;  // texels; of the interval whose depths spread as those of the chords do
};

// The centre, and the middle of the texel, in texels; `optical_depth` is that through the centre.
// Nothing where the texel is not touched.
std::optional<SphereCoverage> sphere_coverage(const float2& center, float radius,
                                              float optical_depth, DensityProfile profile,
                                              const float2& texel);

}  // namespace opacity
