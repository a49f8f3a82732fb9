#include "map/triangle_fragments.hpp"

#include <cmath>

#include "map/surface.hpp"

namespace opacity {
namespace {

// Corners lie on a grid of 1/256 texel, as rasterisers have it. Sums of their products are exact in
// double for triangles of up to 100,000 texels, so that an edge which two of them share gives each
// texel to one.
struct Corner {
    double x, y;
};

Corner snapped(const float4& p) {
    return {std::nearbyint(double(p[0]) * 256.0) / 256.0,
            std::nearbyint(double(p[1]) * 256.0) / 256.0};
}

// Twice the area of a, b, c; positive where they turn left.
double area(const Corner& a, const Corner& b, const Corner& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

// A texel whose middle lies on an edge belongs to the triangle below or to the left of it.
bool owns(const Corner& a, const Corner& b) {
    return b.y < a.y || (b.y == a.y && b.x > a.x);
}

// The texels between two coordinates, one more on each side, within a range.
Rows around(float low, float high, Rows range) {
    const float begin = std::clamp(low - 1.f, float(range.begin), float(range.end));
    const float end = std::clamp(high + 2.f, float(range.begin), float(range.end));
    return {int(begin), int(end)};
}

// The slope of the plane through the corners.
std::array<float, 2> slope_of(const std::array<float4, 3>& p) {
    const double ux = double(p[1][0]) - p[0][0], uy = double(p[1][1]) - p[0][1];
    const double vx = double(p[2][0]) - p[0][0], vy = double(p[2][1]) - p[0][1];
    const double uz = double(p[1][2]) - p[0][2], vz = double(p[2][2]) - p[0][2];
    const double determinant = ux * vy - uy * vx;
    if (determinant == 0.0) return {1e20f, 1e20f};  // as lib/surface.glsl has it
    return {float((uz * vy - vz * uy) / determinant), float((vz * ux - uz * vx) / determinant)};
}

}  // namespace

void triangle_texels(const std::array<float4, 3>& p, const LightSpace& space, Rows rows,
                     const std::function<void(const TriangleTexel&)>& texel) {
    const std::array<Corner, 3> c{snapped(p[0]), snapped(p[1]), snapped(p[2])};
    const double twice_area = area(c[0], c[1], c[2]);
    if (twice_area == 0.0) return;
    const double turn = twice_area > 0.0 ? 1.0 : -1.0;
    const auto [low_x, high_x] = std::minmax({p[0][0], p[1][0], p[2][0]});
    const auto [low_y, high_y] = std::minmax({p[0][1], p[1][1], p[2][1]});
    const Rows columns = around(low_x, high_x, {0, space.map_size_px});
    const Rows band = around(low_y, high_y, rows);
    const float margin = surface_margin(
        slope_of(p), largest_surface_margin(float(space.texels_per_unit), space.depth_range));
    for (int y = band.begin; y < band.end; ++y)
        for (int x = columns.begin; x < columns.end; ++x) {
            const Corner middle{x + 0.5, y + 0.5};
            std::array<double, 3> sides;
            bool inside = true;
            for (std::size_t i = 0; i < 3 && inside; ++i) {
                const Corner &a = c[(i + 1) % 3], &b = c[(i + 2) % 3];
                sides[i] = turn * area(a, b, middle);
                inside =
                    sides[i] > 0.0 || (sides[i] == 0.0 && (turn > 0.0 ? owns(a, b) : owns(b, a)));
            }
            if (!inside) continue;
            TriangleTexel covered{x, y, {}, margin};
            for (std::size_t i = 0; i < 3; ++i)
                covered.weights[i] = float(sides[i] / (turn * twice_area));
            texel(covered);
        }
}

Rows triangle_rows(const LightCaster& caster, const std::uint32_t* corners, const MapFace* face,
                   const SplitPlace& split, int map_size_px) {
    float low = float(map_size_px), high = 0.f;
    int before = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const float4& p = caster.points[corners[i]];
        const float3 q{p[0], p[1], p[2]};
        if (face && face->seen(q)[2] < least_forward) continue;
        const float y = face ? face->place(q)[1] : split.place(q)[1];
        low = std::min(low, y), high = std::max(high, y);
        ++before;
    }
    if (before == 0) return {0, 0};
    if (before < 3) return {0, map_size_px};  // cut, it reaches anywhere
    return rows_between(low - 1.f, high + 1.f, map_size_px);
}

// From the corners as they are, not on the grid: an edge of the mask would show the difference.
TriangleCoverage::TriangleCoverage(const LightCaster& caster, const std::uint32_t* corners,
                                   const std::array<float4, 3>& places)
    : caster_{caster} {
    if (caster.coverage.empty()) return;
    std::array<float4, 3> p = places;
    x_ = p[0][0], y_ = p[0][1];
    uv_ = caster.uvs[corners[0]];
    for (std::size_t axis = 0; axis < 2; ++axis) {
        for (std::size_t i = 0; i < 3; ++i) p[i][2] = caster.uvs[corners[i]][axis];
        const std::array<float, 2> slope = slope_of(p);
        along_x_[axis] = slope[0], along_y_[axis] = slope[1];
    }
    level_ = coverage_level(caster.coverage, along_x_, along_y_);
}

float TriangleCoverage::at(float x, float y) const {
    if (caster_.coverage.empty()) return 1.f;
    float2 uv;
    for (std::size_t axis = 0; axis < 2; ++axis)
        uv[axis] = uv_[axis] + along_x_[axis] * (x - x_) + along_y_[axis] * (y - y_);
    return coverage_at(caster_.coverage, uv, level_);
}

}  // namespace opacity
