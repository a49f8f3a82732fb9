// How dense a particle is at r radii from its middle: (1 - r^2)^k, with k = 0 in a sphere and k = 2
// in a metaball (docs/accuracy.md). Along a chord of half length h, in radii, the optical depth is
// h^(2k + 1) of that through the middle, and depths have the variance h^2 / (2k + 3).
// C++: scene/density_profile.hpp.

const int metaball_profile = 1;  // else a sphere

// h^(2k + 1)
float chord_depth(int profile, float h) {
    if (profile != metaball_profile) return h;
    float h2 = h * h;
    return h2 * h2 * h;
}

// Of the interval of even density whose depths have that variance, in half lengths of the chord.
float even_length(int profile) { return profile == metaball_profile ? 0.65465367 : 1.0; }

// The integral of 15/16 (h^2 - t^2)^2 over 0 .. t.
float metaball_depth(float h, float t) {
    float h2 = h * h, t2 = t * t;
    return 0.9375 * t * (h2 * h2 - t2 * (2.0 / 3.0 * h2 - 0.2 * t2));
}

// The optical depth of such a chord from `begin` to `end`, in radii from its middle.
float chord_depth_within(int profile, float h, float begin, float end) {
    if (profile != metaball_profile) return 0.5 * (end - begin);
    return metaball_depth(h, end) - metaball_depth(h, begin);
}
