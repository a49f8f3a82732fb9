// A sphere of constant density in a texel, by the deposit rule (docs/accuracy.md): the mean opacity
// over the texel. Its disc is cut into rings; each ring's opacity is exact, and the texel gets the
// angle over which the middle of the ring runs inside it. All texels together get all of each ring.
// C++: map/sphere.hpp.
#include "lib/light.glsl"
#include "lib/opacity.glsl"

const float half_circle = 3.14159265;
const float most_ring_texels = 8.0;  // radius; larger ones are sampled at 3 x 3 points a texel
const float least_ring_angle = 1e-5;  // less is rounding

// A sphere with a larger radius than this part of its distance has no picture of its own on a face.
const float near_sphere = 0.25;

// What a ray of light meets of a sphere, in light coordinates: from which depth to which, and which
// part of the diameter; false: nothing.
bool sphere_chord(LightRay ray, vec3 center, float radius, out float begin, out float end, out float part) {
    precise vec3 toward = center - ray.origin;
    precise float middle = dot(toward, ray.direction);
    precise vec3 beside = toward - middle * ray.direction;
    float half_squared = radius * radius - dot(beside, beside);
    begin = end = part = 0.0;
    if (!(half_squared > 0.0)) return false;
    float half_length = sqrt(half_squared);
    begin = max(middle - half_length, ray.begin);
    end = middle + half_length;
    part = 0.5 * (end - begin) / radius;
    return end > begin;
}

struct SphereCoverage {
    float opacity;      // mean over the texel
    float half_length;  // texels; of the interval whose depths spread as those of the chords do
};

// Over what is counted: half chords to the first power and to the third, in radii, and opacity.
struct SphereSums {
    float chords, cubed, opacity;
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

// `low` and `high` are the texel's edges about the centre, in radii.
SphereSums ring_sums(vec2 low, vec2 high, float radius, float optical_depth) {
    vec2 near = max(max(low, -high), vec2(0.0)), far = max(-low, high);
    bool inside = all(lessThanEqual(low, vec2(-1.0))) && all(greaterThanEqual(high, vec2(1.0)));
    int rings = inside ? 1 : int(clamp(ceil(3.0 * radius), 4.0, 24.0));
    precise float nearest = sqrt(near.x * near.x + near.y * near.y);
    precise float farthest = sqrt(far.x * far.x + far.y * far.y);
    int first = int(nearest * float(rings)), last = min(int(farthest * float(rings)) + 1, rings);
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
        precise float c3 = c * c * c, d3 = d * d * d;
        sums.chords += angle * (c3 - d3) / 3.0;
        sums.cubed += angle * (c3 * c * c - d3 * d * d) / 5.0;
        sums.opacity += angle * (chord_opacity(optical_depth, c) - chord_opacity(optical_depth, d));
    }
    sums.opacity *= radius * radius;
    return sums;
}

SphereSums point_sums(vec2 low, float radius, float optical_depth) {
    SphereSums sums = SphereSums(0.0, 0.0, 0.0);
    for (int i = 0; i < 9; ++i) {
        precise vec2 p = low + (vec2(i % 3, i / 3) + 0.5) / (3.0 * radius);
        precise float c = sqrt(max(1.0 - (p.x * p.x + p.y * p.y), 0.0));
        sums.chords += c;
        sums.cubed += c * c * c;
        sums.opacity += opacity_of(optical_depth * c) / 9.0;
    }
    return sums;
}

// The centre, and the middle of the texel, in texels; `optical_depth` is that through the centre.
bool sphere_coverage(vec2 center, float radius, float optical_depth, vec2 texel, out SphereCoverage coverage) {
    coverage = SphereCoverage(0.0, 0.0);
    if (!(radius > 0.0)) return false;
    precise vec2 low = (texel - 0.5 - center) / radius, high = (texel + 0.5 - center) / radius;
    SphereSums sums = SphereSums(0.0, 0.0, 0.0);
    if (radius < most_ring_texels) sums = ring_sums(low, high, radius, optical_depth);
    else sums = point_sums(low, radius, optical_depth);
    if (!(sums.chords > 0.0)) return false;
    coverage = SphereCoverage(min(sums.opacity, 1.0), radius * sqrt(sums.cubed / sums.chords));
    return true;
}
