// The hairy teapot: Martin Newell's of 1975, in a short coat of fur, in centimetres.
#include <array>
#include <utility>

#include "io/demo.hpp"
#include "io/demo_coat.hpp"
#include "io/demo_triangles.hpp"

namespace opacity::demo {
namespace {

// Newell's control points are 3 units high; a real teapot of this shape is some 16 cm high.
constexpr double unit = 5.0;

// A cubic Bezier curve.
template <class Point>
Point bezier(const std::array<Point, 4>& c, double t) {
    const double s = 1.0 - t;
    return s * s * s * c[0] + 3.0 * s * s * t * c[1] + 3.0 * s * t * t * c[2] + t * t * t * c[3];
}

using Profile = std::array<glm::dvec2, 4>;  // distance from the axis, height
// From the middle of the bottom up to the rim.
constexpr Profile pot[] = {{{{0.0, 0.0}, {1.425, 0.0}, {1.5, 0.075}, {1.5, 0.15}}},
                           {{{1.5, 0.15}, {1.5, 0.225}, {2.0, 0.45}, {2.0, 0.9}}},
                           {{{2.0, 0.9}, {2.0, 1.35}, {1.75, 1.875}, {1.5, 2.4}}},
                           {{{1.5, 2.4}, {1.4375, 2.53125}, {1.3375, 2.53125}, {1.4, 2.4}}}};
// From the lid's edge, inside the rim, up to the top of its knob.
constexpr Profile lid[] = {{{{1.4, 2.4}, {1.3, 2.3}, {1.3, 2.25}, {1.3, 2.25}}},
                           {{{1.3, 2.25}, {1.3, 2.4}, {0.4, 2.4}, {0.2, 2.55}}},
                           {{{0.2, 2.55}, {0.0, 2.7}, {0.8, 3.15}, {0.0, 3.15}}}};

// A limb of the pot: a curve of its upper or outer side, one of the other, and half its thickness
// across at the four control points.
struct Limb {
    Profile inner, outer;  // along the pot's x axis, height
    std::array<double, 4> half_width;
};
constexpr std::array<double, 4> handle_width{0.3, 0.3, 0.3, 0.3};
constexpr Limb limbs[] = {{{{{-1.6, 2.025}, {-2.3, 2.025}, {-2.7, 2.025}, {-2.7, 1.8}}},
                           {{{-1.5, 2.25}, {-2.5, 2.25}, {-3.0, 2.25}, {-3.0, 1.8}}},
                           handle_width},
                          {{{{-2.7, 1.8}, {-2.7, 1.575}, {-2.5, 1.125}, {-2.0, 0.9}}},
                           {{{-3.0, 1.8}, {-3.0, 1.35}, {-2.65, 0.9375}, {-1.9, 0.6}}},
                           handle_width},
                          {{{{1.7, 1.425}, {2.6, 1.425}, {2.3, 2.1}, {2.7, 2.4}}},
                           {{{1.7, 0.6}, {3.1, 0.825}, {2.4, 2.025}, {3.3, 2.4}}},
                           {0.66, 0.66, 0.25, 0.25}},
                          {{{{2.7, 2.4}, {2.8, 2.475}, {2.9, 2.475}, {2.8, 2.4}}},
                           {{{3.3, 2.4}, {3.525, 2.49375}, {3.45, 2.5125}, {3.2, 2.4}}},
                           {0.25, 0.25, 0.15, 0.15}}};

template <std::size_t Curves>
std::vector<glm::dvec2> sampled(const Profile (&profile)[Curves]) {
    constexpr int steps = 12;
    std::vector<glm::dvec2> points{unit * profile[0][0]};
    for (const Profile& curve : profile)
        for (int step = 1; step <= steps; ++step)
            points.push_back(unit * bezier(curve, double(step) / steps));
    return points;
}

// Across, a limb is two mirrored cubic curves between its inner and its outer side.
void add_limb(Triangles& mesh, const Limb& limb) {
    constexpr std::uint32_t half = 10, around = 2 * half;
    constexpr int steps = 14;
    for (int step = 0; step <= steps; ++step) {
        const double t = double(step) / steps;
        const glm::dvec2 inner = bezier(limb.inner, t), outer = bezier(limb.outer, t);
        const double width = bezier(limb.half_width, t);
        for (std::uint32_t i = 0; i < around; ++i) {
            const double u = double(i % half) / half, side = i < half ? -1.0 : 1.0;
            const double s = i < half ? u : 1.0 - u;
            const glm::dvec3 p = bezier<glm::dvec3>({{{inner.x, 0.0, inner.y},
                                                      {inner.x, side * width, inner.y},
                                                      {outer.x, side * width, outer.y},
                                                      {outer.x, 0.0, outer.y}}},
                                                    s);
            mesh.add(unit * p);
        }
        if (step > 0) mesh.band(mesh.count() - 2 * around, mesh.count() - around, around);
    }
}

std::shared_ptr<Mesh> teapot() {
    Triangles triangles;
    add_revolved(triangles, sampled(pot), 64);
    add_revolved(triangles, sampled(lid), 64);
    for (const Limb& limb : limbs) add_limb(triangles, limb);
    return mesh(std::move(triangles), {{0.22f, 0.12f, 0.08f}});
}

Lie fur_at(const glm::dvec3& p, const glm::dvec3& normal) {
    const bool on_handle = p.x<-1.95 * unit, on_spout = p.x> 2.05 * unit;
    const glm::dvec3 warm{0.5, 0.27, 0.12}, cream{0.62, 0.5, 0.36};
    Lie lie;
    lie.length = on_spout || on_handle ? 0.75 : 1.15;
    lie.lift = 0.75;
    lie.comb = on_spout ? glm::dvec3{0.7, 0.0, 0.9} : glm::dvec3{-0.25 * p.y, 0.25 * p.x, -4.0};
    const double light = on_spout || on_handle ? 0.8 : glm::smoothstep(2.2 * unit, 2.5 * unit, p.z);
    lie.tip_color = warm + light * (cream - warm);
    lie.root_color = 0.4 * lie.tip_color;
    // The bottom stands on the ground, and the lid's edge lies in the rim.
    if (normal.z < -0.8 && p.z < 0.1 * unit) lie.length = 0.0;
    return lie;
}

}  // namespace

std::vector<ShapePtr> teapot(const Request& request) {
    const std::shared_ptr<Mesh> body = teapot();
    return {coat(*body, request, fur_at), body, ground(60.0, {0.5f, 0.47f, 0.44f})};
}

}  // namespace opacity::demo
