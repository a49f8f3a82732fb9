// What a light's map leaves out: no box with a point that lies in it, and most that do not.
#include "scene/map_window.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "core/vector.hpp"

using namespace opacity;

namespace {

constexpr int size_px = 64;

LightFace face_towards(const double3& forward, const double3& offset, double half_side) {
    const double3 z = scaled(forward, 1.0 / length(forward));
    const double3 aside = std::abs(z[0]) < 0.7 ? double3{1, 0, 0} : double3{0, 1, 0};
    double3 y = cross(z, aside);
    y = scaled(y, 1.0 / length(y));
    const double3 x = cross(y, z);
    LightFace face;
    face.axes = {x[0], x[1], x[2], y[0], y[1], y[2], z[0], z[1], z[2]};
    face.offset = face.seen(offset);
    face.focal_px = 0.5 * size_px / half_side;
    face.middle_px = {0.5 * size_px, 0.5 * size_px};
    face.depth_of_origin = length(offset) - 0.3;
    return face;
}

// Of all kinds, about a scene of size 1 in the origin.
LightSpace random_space(std::mt19937& engine, int kind) {
    std::uniform_real_distribution<double> any{-1.0, 1.0};
    LightSpace space;
    space.map_size_px = size_px;
    const auto direction = [&] { return double3{any(engine), any(engine), any(engine) + 2.0}; };
    if (kind < 2) {
        space.from_world = {90, 5, 0, 30, -5, 90, 0, 25, 0, 0, 1, 0.5, 0, 0, 0, 1};
        space.texels_per_unit = std::hypot(90.0, 5.0);
        if (kind == 1)
            space.splits = {{1.0, {0.0, 0.0}}, {3.0, {-60.0 + 20.0 * any(engine), -70.0}}};
        return space;
    }
    for (int face = 0; face < (kind == 2 ? 1 : 3); ++face)
        space.faces.push_back(face_towards(direction(), {any(engine), any(engine), 1.0}, 0.4));
    return space;
}

bool is_held(const LightSpace& space, const double3& world) {
    const double3 q = transform_point(space.from_world, world);
    const auto is_within = [](double x) { return x >= 0.0 && x <= size_px; };
    const auto is_in = [&](const double3& p) {
        return is_within(p[0]) && is_within(p[1]) && p[2] <= 1.0;
    };
    if (space.is_parallel()) {
        const std::vector<LightSplit> whole{{}};
        const std::vector<LightSplit>& splits = space.splits.empty() ? whole : space.splits;
        return std::ranges::any_of(splits,
                                   [&](const auto& split) { return is_in(split.place(q)); });
    }
    return std::ranges::any_of(space.faces, [&](const LightFace& face) {
        const double3 r = face.seen(q);
        if (!(r[2] > 0.0)) return false;
        return is_in({face.focal_px * r[0] / r[2] + face.middle_px[0],
                      face.focal_px * r[1] / r[2] + face.middle_px[1],
                      length(r) - length(face.offset) + face.depth_of_origin});
    });
}

}  // namespace

TEST_CASE("what the map holds is never left out") {
    std::mt19937 engine{7};
    std::uniform_real_distribution<double> place{-3.0, 3.0}, part{0.0, 1.0};
    int left_out = 0, held = 0;
    for (int trial = 0; trial < 4000; ++trial) {
        const LightSpace space = random_space(engine, trial % 4);
        Box box;
        const double3 corner{place(engine), place(engine), place(engine)};
        box.extend(corner);
        box.extend(plus(corner, {part(engine), part(engine), part(engine)}));
        const bool out = is_out_of_map(space, box, 0.0);
        left_out += out;
        for (int sample = 0; sample < 50; ++sample) {
            double3 p;
            for (std::size_t axis = 0; axis < 3; ++axis)
                p[axis] = box.min[axis] + part(engine) * (box.max[axis] - box.min[axis]);
            const bool here = is_held(space, p);
            held += here;
            if (here) CHECK_FALSE(out);
        }
    }
    CHECK(left_out > 1500);
    CHECK(held > 500);
}

TEST_CASE("widths reach into the map from beside it") {
    std::mt19937 engine{1};
    const LightSpace space = random_space(engine, 0);
    Box box;
    box.extend(double3{-0.5, 0.0, 0.0});  // some 15 texels beside
    CHECK(is_out_of_map(space, box, 0.0));
    CHECK_FALSE(is_out_of_map(space, box, 0.2));
    CHECK(is_out_of_map(space, Box{}, 1.0));
}

TEST_CASE("a light among its casters sees what is about it") {
    std::mt19937 engine{1};
    LightSpace space = random_space(engine, 2);
    const double3 place = space.faces[0].turned_back(scaled(space.faces[0].offset, -1.0));
    Box behind;
    behind.extend(plus(place, space.faces[0].turned_back({0.0, 0.0, -0.1})));
    CHECK(is_out_of_map(space, behind, 0.0));
    CHECK_FALSE(is_out_of_map(space, behind, 0.05));
}
