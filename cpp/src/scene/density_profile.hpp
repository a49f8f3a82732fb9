// How dense a particle is at r radii from its middle: (1 - r^2)^k, with k = 0 in a sphere and k = 2
// in a metaball (docs/accuracy.md). Along a chord of half length h, in radii, the optical depth is
// h^(2k + 1) of that through the middle, and depths have the variance h^2 / (2k + 3).
// GLSL: lib/density_profile.glsl.
#pragma once

#include "opacity/scene/particles.hpp"

namespace opacity {

// h^(2k + 1)
template <class Real>
Real chord_depth(DensityProfile profile, Real h) {
    if (profile != DensityProfile::metaball) return h;
    const Real h2 = h * h;
    return h2 * h2 * h;
}

// Of the interval of even density whose depths have that variance, in half lengths of the chord.
inline float even_length(DensityProfile profile) {
    return profile == DensityProfile::metaball ? 0.65465367f : 1.f;  // sqrt(3 / 7)
}

// The integral of 15/16 (h^2 - t^2)^2 over 0 .. t.
template <class Real>
Real metaball_depth(Real h, Real t) {
    const Real h2 = h * h, t2 = t * t;
    return Real(0.9375) * t * (h2 * h2 - t2 * (Real(2) / Real(3) * h2 - Real(0.2) * t2));
}

// The optical depth of such a chord from `begin` to `end`, in radii from its middle.
template <class Real>
Real chord_depth_within(DensityProfile profile, Real h, Real begin, Real end) {
    if (profile != DensityProfile::metaball) return Real(0.5) * (end - begin);
    return metaball_depth(h, end) - metaball_depth(h, begin);
}

}  // namespace opacity
