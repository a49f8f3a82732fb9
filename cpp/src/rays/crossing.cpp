#include "rays/crossing.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "scene/density_profile.hpp"

namespace opacity::rays {
namespace {

// How the axis of one segment passes the ray, which stands at (0, 0) of the plane across it.
struct Pass {
    bool has_length = false;  // seen along the ray
    // Whether the axis comes nearer to the ray at its first and at its last point.
    bool approaches_first = false, approaches_last = false;
    bool inside = false, first_inside = false, last_inside = false;  // within half a width
    double along = 0.0;                                              // of the nearest point, 0 .. 1
    double squared = 0.0;  // of the distance between that point and the ray
    double distance_first = 0.0, distance_last = 0.0;  // along the ray
};

double squared_across(const double3& p) {
    return p[0] * p[0] + p[1] * p[1];
}

bool is_inside(double squared, double half_width) {
    return squared <= half_width * half_width;
}

Pass pass(const Casters& casters, const Ray& ray, std::uint32_t segment) {
    const Vertex* vertex = &casters.vertices[casters.segments[segment]];
    const double3 a = ray.seen(vertex[0].position), b = ray.seen(vertex[1].position);
    const double ex = b[0] - a[0], ey = b[1] - a[1];
    const double length_squared = ex * ex + ey * ey;
    const double nearer_a = -(a[0] * ex + a[1] * ey), nearer_b = -(b[0] * ex + b[1] * ey);
    Pass p;
    p.has_length = length_squared > 0.0;
    p.approaches_first = nearer_a >= 0.0;
    p.approaches_last = nearer_b >= 0.0;
    if (p.has_length)
        p.along = p.approaches_last ? 1.0 : std::clamp(nearer_a / length_squared, 0.0, 1.0);
    const double half_a = vertex[0].half_width, half_b = vertex[1].half_width;
    // An end is seen as from the next segment, bit for bit.
    if (p.along == 0.0 || p.along == 1.0)
        p.squared = squared_across(p.along == 0.0 ? a : b);
    else
        p.squared = squared_across({a[0] + p.along * ex, a[1] + p.along * ey, 0.0});
    p.inside = is_inside(p.squared, half_a + p.along * (half_b - half_a));
    p.first_inside = is_inside(squared_across(a), half_a);
    p.last_inside = is_inside(squared_across(b), half_b);
    p.distance_first = a[2];
    p.distance_last = b[2];
    return p;
}

// Whether a strand goes on from this segment to the next one.
bool goes_on(const Casters& casters, std::uint32_t segment) {
    return segment + 1 < casters.segments.size() &&
           casters.segments[segment + 1] == casters.segments[segment] + 1;
}

// Of the places in a stretch where the axis stops coming nearer, the nearest.
class Nearest {
   public:
    explicit Nearest(const Casters& casters) : casters_{casters} {}

    // In the order of the strand. At either end of the strand the axis does not stop coming nearer
    // but ends: so ends are flat.
    void visit(std::uint32_t segment, const Pass& p) {
        if (!p.has_length) return;
        if (before_.approaches_last && !p.approaches_first) offer(before_segment_, before_, 1.0);
        if (p.approaches_first && !p.approaches_last) offer(segment, p, p.along);
        before_ = p;
        before_segment_ = segment;
    }
    const std::optional<Crossing>& crossing() const { return crossing_; }

   private:
    void offer(std::uint32_t segment, const Pass& p, double along) {
        if (crossing_ && squared_ <= p.squared) return;
        const Vertex* vertex = &casters_.vertices[casters_.segments[segment]];
        const double distance = std::lerp(p.distance_first, p.distance_last, along);
        crossing_ = {distance,
                     optical_depth(std::lerp(vertex[0].opacity, vertex[1].opacity, along))};
        squared_ = p.squared;
    }

    const Casters& casters_;
    std::optional<Crossing> crossing_;
    double squared_ = 0.0;
    Pass before_;  // the segment before that has a length; at first none, which comes no nearer
    std::uint32_t before_segment_ = 0;
};

// Twice the signed area of (0, p, q). Equal but for its sign when p and q are exchanged, whatever
// the compiler fuses: an edge is the same from both of its triangles.
double area(const double3& p, const double3& q) {
    const bool swapped = q[0] < p[0] || (q[0] == p[0] && q[1] < p[1]);
    const double3 &low = swapped ? q : p, &high = swapped ? p : q;
    const double result = low[0] * high[1] - low[1] * high[0];
    return swapped ? -result : result;
}

// Of the two triangles beside an edge through the ray one owns it: the one to whose left it runs
// up, or to the side.
bool owns(double signed_area, const double3& from, const double3& to) {
    if (signed_area != 0.0) return signed_area > 0.0;
    return to[1] > from[1] || (to[1] == from[1] && to[0] < from[0]);
}

// 1 where no alpha map says otherwise.
double coverage(const Casters& casters, std::uint32_t triangle, const std::array<double, 2>& uv) {
    const auto after =
        std::upper_bound(casters.foliage.begin(), casters.foliage.end(), triangle,
                         [](std::uint32_t t, const Foliage& foliage) { return t < foliage.first; });
    if (after == casters.foliage.begin() || triangle >= (after - 1)->end) return 1.0;
    return (after - 1)->coverage.at(uv);
}

}  // namespace

double optical_depth(double opacity) {
    return -std::log1p(-std::min(opacity, 1.0 - 0x1p-24));
}

bool touches(const Casters& casters, const Ray& ray, std::uint32_t segment) {
    return pass(casters, ray, segment).inside;
}

Stretch stretch_around(const Casters& casters, const Ray& ray, std::uint32_t segment) {
    Pass current = pass(casters, ray, segment);
    while (current.first_inside && segment > 0 && goes_on(casters, segment - 1)) {
        const Pass before = pass(casters, ray, segment - 1);
        if (!before.inside) break;
        current = before;
        --segment;
    }
    Nearest nearest{casters};
    nearest.visit(segment, current);
    while (current.last_inside && goes_on(casters, segment)) {
        current = pass(casters, ray, segment + 1);
        if (!current.inside) break;
        nearest.visit(++segment, current);
    }
    return {segment, nearest.crossing()};
}

std::optional<Crossing> cross_triangle(const Casters& casters, const Ray& ray,
                                       std::uint32_t triangle) {
    std::array<const Vertex*, 3> vertex{};
    std::array<double3, 3> seen{};
    for (std::size_t i = 0; i < 3; ++i) {
        vertex[i] = &casters.vertices[casters.triangles[triangle][i]];
        seen[i] = ray.seen(vertex[i]->position);
    }
    std::array<double, 3> weight{area(seen[1], seen[2]), area(seen[2], seen[0]),
                                 area(seen[0], seen[1])};
    const double sum = weight[0] + weight[1] + weight[2];
    if (sum == 0.0) return {};
    const double sign = sum > 0.0 ? 1.0 : -1.0;  // counter-clockwise from here on
    double distance = 0.0, opacity = 0.0;
    std::array<double, 2> uv{};
    for (std::size_t i = 0; i < 3; ++i) {
        const double3 &from = seen[(i + 1) % 3], &to = seen[(i + 2) % 3];
        if (!owns(sign * weight[i], sign > 0.0 ? from : to, sign > 0.0 ? to : from)) return {};
        distance += weight[i] / sum * seen[i][2];
        opacity += weight[i] / sum * vertex[i]->opacity;
        for (std::size_t k = 0; k < 2; ++k) uv[k] += weight[i] / sum * vertex[i]->uv[k];
    }
    return Crossing{distance, optical_depth(opacity * coverage(casters, triangle, uv))};
}

double optical_depth_through(const Sphere& sphere, const Ray& ray, const Span& span) {
    const double3 seen = ray.seen(sphere.center);
    const double squared = sphere.radius * sphere.radius - squared_across(seen);
    if (!(squared > 0.0)) return 0.0;
    const double half = std::sqrt(squared);
    const double begin = std::max(-half, span.from - seen[2]);
    const double end = std::min(half, span.to - seen[2]);
    if (!(end > begin)) return 0.0;
    return sphere.optical_depth * chord_depth_within(sphere.profile, half / sphere.radius,
                                                     begin / sphere.radius, end / sphere.radius);
}

}  // namespace opacity::rays
