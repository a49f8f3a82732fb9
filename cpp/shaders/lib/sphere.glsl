// A particle in a texel, by the deposit rule (docs/accuracy.md): the mean opacity over the texel. Its
// disc is cut into rings; each ring's opacity is exact, and the texel gets the angle over which the
// middle of the ring runs inside it. All texels together get all of each ring.
// C++: map/sphere.hpp.
#include "lib/light.glsl"
#include "lib/opacity.glsl"
#include "lib/density_profile.glsl"

const float half_circle = 3.14159265;
const float most_ring_texels = 8.0;  // radius; larger ones are sampled at 3 x 3 points a texel
const float least_ring_angle = 1e-5;  // less is rounding

// A sphere with a larger radius than this part of its distance has no picture of its own on a face.
const float near_sphere = 0.25;

// What a ray of light meets of a particle, in light coordinates: the interval, and which part of the
// optical depth through the middle; false: nothing.
bool sphere_chord(LightRay ray, vec3 center, float radius, int profile, out float begin, out float end,
                  out float part) {
    precise vec3 toward = center - ray.origin;
    precise float middle = dot(toward, ray.direction);
    precise vec3 beside = toward - middle * ray.direction;
    float half_squared = radius * radius - dot(beside, beside);
    begin = end = part = 0.0;
    if (!(half_squared > 0.0)) return false;
    float half_length = sqrt(half_squared);
    if (!(middle + half_length > ray.begin)) return false;
    float first = max(-half_length, ray.begin - middle);
    part = chord_depth_within(profile, half_length / radius, first / radius, half_length / radius);
    float even = even_length(profile) * half_length;
    begin = middle + max(-even, first);
    end = max(middle + even, begin);
    return true;
}

struct SphereCoverage {
    float opacity;      // mean over the texel
    float half_length;  // texels; of the interval whose depths spread as those of the chords do
};

// Over what is counted: optical depth, in that through the middle; the same times the square of an
// interval of even density, in radii; opacity.
struct SphereSums {
    float depth, spread, opacity;
};

// pi / 2 + asin(x) to 1e-7, where built-in ones may be far from that: Abramowitz and Stegun 1964,
// 4.4.46.
float arc_below(float x) {
    float a = min(abs(x), 1.0);
    float series = -0.0012624911;
    series = series * a + 0.0066700901;
    series = series * a - 0.0170881256;
    series = series * a + 0.0308918810;
    series = series * a - 0.0501743046;
    series = series * a + 0.0889789874;
    series = series * a - 0.2145988016;
    series = series * a + 1.5707963050;
    precise float arc = sqrt(1.0 - a) * series;
    return x < 0.0 ? arc : half_circle - arc;
}

// Of a circle the angle that lies below both of two lines across the axes, which cut it at arcs.
float angle_below(float x_arc, float y_arc) {
    float sum = x_arc + y_arc;
    return max(min(2.0 * min(x_arc, y_arc), sum - 0.5 * half_circle), 0.0) +
           max(sum - 1.5 * half_circle, 0.0);
}

// The integral of (1 - exp(-optical_depth c)) c over half chords of 0 .. c, in radii.
float chord_opacity(float optical_depth, float c) {
    float x = optical_depth * c;
    if (!(x < 0.5)) return c * c * (0.5 - (1.0 - exp(-x) * (1.0 + x)) / (x * x));
    float series = 1.0 / 45360.0;
    series = 1.0 / 5760.0 - x * series;
    series = 1.0 / 840.0 - x * series;
    series = 1.0 / 144.0 - x * series;
    series = 1.0 / 30.0 - x * series;
    series = 1.0 / 8.0 - x * series;
    series = 1.0 / 3.0 - x * series;
    return c * c * x * series;
}

// Of a metaball the integral of (1 - exp(-optical_depth c^5)) c over half chords of d .. c: Gauss's
// rule of three points in c^2, 1.4e-4 from exact over four rings of optical depth 16.6.
float metaball_opacity(float optical_depth, float c, float d) {
    precise float middle = 0.5 * (c * c + d * d), apart = 0.38729833 * (c * c - d * d);
    vec3 squared = vec3(middle - apart, middle, middle + apart), sum = vec3(0.0);
    for (int i = 0; i < 3; ++i)
        sum[i] = opacity_of(optical_depth * squared[i] * squared[i] * sqrt(squared[i]));
    return 0.25 * (c * c - d * d) * dot(sum, vec3(5.0, 8.0, 5.0) / 9.0);
}

float ring_opacity(int profile, float optical_depth, float c, float d) {
    if (profile == metaball_profile) return metaball_opacity(optical_depth, c, d);
    return chord_opacity(optical_depth, c) - chord_opacity(optical_depth, d);
}

// `low` and `high` are the texel's edges about the centre, in radii.
SphereSums ring_sums(vec2 low, vec2 high, float radius, float optical_depth, int profile) {
    vec2 near = max(max(low, -high), vec2(0.0)), far = max(-low, high);
    bool inside = all(lessThanEqual(low, vec2(-1.0))) && all(greaterThanEqual(high, vec2(1.0)));
    bool is_metaball = profile == metaball_profile;
    int rings = inside && !is_metaball ? 1 : int(clamp(ceil(3.0 * radius), 4.0, 24.0));
    precise float nearest = sqrt(near.x * near.x + near.y * near.y);
    precise float farthest = sqrt(far.x * far.x + far.y * far.y);
    int first = int(nearest * float(rings)), last = min(int(farthest * float(rings)) + 1, rings);
    float power = is_metaball ? 7.0 : 3.0;  // 2k + 3
    SphereSums sums = SphereSums(0.0, 0.0, 0.0);
    for (int ring = first; ring < last; ++ring) {
        precise float begin = float(ring) / float(rings), end = float(ring + 1) / float(rings);
        precise float middle = 0.5 * (begin + end);
        float low_x = arc_below(low.x / middle), low_y = arc_below(low.y / middle);
        float high_x = arc_below(high.x / middle), high_y = arc_below(high.y / middle);
        precise float angle = (angle_below(high_x, high_y) - angle_below(low_x, high_y)) -
                              (angle_below(high_x, low_y) - angle_below(low_x, low_y));
        if (!(angle > least_ring_angle)) continue;
        precise float c = sqrt(max(1.0 - begin * begin, 0.0)), d = sqrt(max(1.0 - end * end, 0.0));
        precise float c_depth = c * c * chord_depth(profile, c), d_depth = d * d * chord_depth(profile, d);
        sums.depth += angle * (c_depth - d_depth) / power;
        sums.spread += angle * (c_depth * c * c - d_depth * d * d) / (power + 2.0);
        sums.opacity += angle * ring_opacity(profile, optical_depth, c, d);
    }
    sums.opacity *= radius * radius;
    return sums;
}

SphereSums point_sums(vec2 low, float radius, float optical_depth, int profile) {
    SphereSums sums = SphereSums(0.0, 0.0, 0.0);
    for (int i = 0; i < 9; ++i) {
        precise vec2 p = low + (vec2(i % 3, i / 3) + 0.5) / (3.0 * radius);
        precise float c = sqrt(max(1.0 - (p.x * p.x + p.y * p.y), 0.0));
        float depth = chord_depth(profile, c);
        sums.depth += depth;
        sums.spread += depth * c * c;
        sums.opacity += opacity_of(optical_depth * depth) / 9.0;
    }
    return sums;
}

// The centre, and the middle of the texel, in texels; `optical_depth` is that through the centre.
bool sphere_coverage(vec2 center, float radius, float optical_depth, int profile, vec2 texel,
                     out SphereCoverage coverage) {
    coverage = SphereCoverage(0.0, 0.0);
    if (!(radius > 0.0)) return false;
    precise vec2 low = (texel - 0.5 - center) / radius, high = (texel + 0.5 - center) / radius;
    SphereSums sums = SphereSums(0.0, 0.0, 0.0);
    if (radius < most_ring_texels) sums = ring_sums(low, high, radius, optical_depth, profile);
    else sums = point_sums(low, radius, optical_depth, profile);
    if (!(sums.depth > 0.0)) return false;
    float half_length = radius * even_length(profile) * sqrt(sums.spread / sums.depth);
    coverage = SphereCoverage(min(sums.opacity, 1.0), half_length);
    return true;
}
