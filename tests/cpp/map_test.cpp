// Maps in C++: the fragments of casters hold their area, each texel gets them once and in the same
// order, and receivers know what they themselves left in the map.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <numbers>
#include <numeric>
#include <random>
#include <tuple>
#include <vector>

#include "map/filter.hpp"
#include "map/fragments.hpp"
#include "map/own_deposit.hpp"
#include "map/planes.hpp"
#include "opacity/scene/mesh.hpp"
#include "opacity/scene/scene.hpp"
#include "opacity/scene/strands.hpp"
#include "scene/light_fit.hpp"

using namespace opacity;
using doctest::Approx;

namespace {

constexpr int size_px = 128;

// A map of 10 x 10 world units about the origin, seen along z.
LightSpace plain_space() {
    LightSpace space;
    space.map_size_px = size_px;
    space.depth_range = 10.0;
    space.texels_per_unit = size_px / 10.0;
    space.from_world = {
        space.texels_per_unit, 0, 0, 64, 0, space.texels_per_unit, 0, 64, 0, 0, .1, .5, 0, 0, 0, 1};
    return space;
}

class Random {
   public:
    double operator()(double low, double high) {
        return low + (high - low) * double(engine_()) / 4294967295.0;
    }

   private:
    std::mt19937 engine_{7};
};

ShapePtr strand(std::vector<double> xyz, std::vector<float> width, std::vector<float> opacity) {
    const auto count = std::int64_t(xyz.size() / 3);
    return std::make_shared<Strands>(Positions{std::move(xyz)}, std::vector<std::int64_t>{0, count},
                                     std::move(width), std::move(opacity));
}

// From the middle of the map, `length` long, in `parts` segments.
ShapePtr straight(double angle, double length, double width, int parts, float opacity = 0.6f) {
    std::vector<double> xyz;
    for (int i = 0; i <= parts; ++i) {
        const double along = length * (double(i) / parts - 0.47);
        xyz.insert(xyz.end(),
                   {along * std::cos(angle) + 0.013, along * std::sin(angle), 3.0 * i / parts});
    }
    return strand(std::move(xyz), {float(width)}, {opacity});
}

ShapePtr mesh(std::vector<double> xyz, std::vector<std::uint32_t> triangles, float opacity = 0.5f) {
    return std::make_shared<Mesh>(Positions{std::move(xyz)}, std::move(triangles),
                                  std::vector<float3>{}, std::vector<float>{opacity});
}

// Twenty strands and a surface, anywhere about the map and beyond its edges.
std::vector<ShapePtr> tangle() {
    Random random;
    std::vector<double> xyz, corners;
    std::vector<std::int64_t> offsets{0};
    for (int i = 0; i < 100; ++i) {
        xyz.insert(xyz.end(), {random(-6, 6), random(-6, 6), random(-5, 5)});
        if (i % 5 == 4) offsets.push_back(i + 1);
    }
    std::vector<std::uint32_t> triangles;
    for (std::uint32_t i = 0; i < 30; ++i) {
        corners.insert(corners.end(), {random(-6, 6), random(-6, 6), random(-5, 5)});
        triangles.push_back(i);
    }
    return {std::make_shared<Strands>(Positions{xyz}, offsets, std::vector<float>{0.15f}),
            mesh(corners, triangles)};
}

// Of a light in the middle of the shapes.
LightSpace space_of_point_among(const std::vector<ShapePtr>& shapes) {
    Scene scene;
    for (const ShapePtr& shape : shapes) scene.add(shape);
    return LightFit{}.fit(scene, PointLight{{0.1, 0.2, 0.3}}, [](double) { return size_px; }, {});
}

using Texels = std::vector<std::vector<Fragment>>;  // each in the order of arrival

Texels fragments_of(const FragmentSource& source) {
    Texels texels(std::size_t(source.space.width_px()) * source.space.height_px());
    for_each_fragment(source, [&](const Fragment& f) { texels[f.texel].push_back(f); });
    return texels;
}

// The same of every primitive in one band of rows, on one thread.
Texels in_one_band(const FragmentSource& source) {
    const LightSpace& space = source.space;
    Texels texels(std::size_t(space.width_px()) * space.height_px());
    const auto add = [&](const Fragment& f) { texels[f.texel].push_back(f); };
    const MapFaces faces{space};
    for (int face = 0; face < space.face_count(); ++face) {
        const FragmentSource through = source.through(space, face);
        FragmentSink sink{through, space.corner_px(face), add};
        for (const ShapePtr& shape : source.shapes) {
            const LightCaster& caster = source.casters.caster(shape, space);
            std::vector<std::uint32_t> every(primitive_count(caster));
            std::iota(every.begin(), every.end(), 0u);
            caster_fragments(caster, every, through, space.is_parallel() ? nullptr : &faces[face],
                             {0, space.map_size_px}, sink);
        }
    }
    return texels;
}

// World units squared; what of it a fragment covers follows from its optical depth.
double area_of(const Texels& texels, double opacity, const LightSpace& space) {
    double covered = 0.0;
    for (const auto& texel : texels)
        for (const Fragment& f : texel) covered += f.optical_depth;
    return covered / -std::log1p(-opacity) / (space.texels_per_unit * space.texels_per_unit);
}

double optical_depth_sum(const std::vector<Fragment>& fragments) {
    double sum = 0.0;
    for (const Fragment& f : fragments) sum += f.optical_depth;
    return sum;
}

}  // namespace

// At a small opacity tau is the covered part times the opacity, to a thousandth.
TEST_CASE("a strand deposits its area: thin or wide, turned, cut") {
    const LightSpace space = plain_space();
    const float opacity = 1e-3f;
    for (const double width_texels : {0.1, 0.5, 1.0, 2.5, 10.0})
        for (const double angle : {0.0, 0.3, 0.7, std::numbers::pi / 4, 1.2, 2.0, 3.9})
            for (const int parts : {1, 7, 200}) {
                CAPTURE(width_texels);
                CAPTURE(angle);
                CAPTURE(parts);
                const double width = width_texels / space.texels_per_unit, length = 5.5;
                const std::vector<ShapePtr> shapes{straight(angle, length, width, parts, opacity)};
                LightCasters casters;
                const Texels texels = fragments_of({casters, shapes, space, {}});
                CHECK(area_of(texels, opacity, space) == Approx(length * width).epsilon(0.01));
            }
}

// tau = -f log(1 - opacity c): f and c of each fragment follow from its optical depth where the
// strand runs along an axis, and where it does not their sum over the texels does.
TEST_CASE("at any opacity a wide strand lets 1 - opacity through, a thin one its part") {
    const LightSpace space = plain_space();
    const auto deepest = [&](double width_texels, double y_texels, float opacity) {
        const double width = width_texels / space.texels_per_unit;
        const double y = y_texels / space.texels_per_unit;
        const std::vector<ShapePtr> shapes{strand({-4, y, 0, 4, y, 0}, {float(width)}, {opacity})};
        LightCasters casters;
        const Texels texels = fragments_of({casters, shapes, space, {}});
        return optical_depth_sum(texels[64 * size_px + 64]);
    };
    for (const float opacity : {0.1f, 0.5f, 0.99f}) {
        CHECK(deepest(3.0, 0.5, opacity) == Approx(-std::log1p(-double(opacity))).epsilon(1e-5));
        CHECK(deepest(0.25, 0.5, opacity) == Approx(-std::log1p(-0.25 * opacity)).epsilon(1e-5));
        // Half beside the texel.
        CHECK(deepest(0.25, 0.0, opacity) == Approx(-std::log1p(-0.125 * opacity)).epsilon(1e-4));
    }
}

TEST_CASE("bands of rows share nothing: each texel has the fragments of one loop, in its order") {
    const std::vector<ShapePtr> shapes = tangle();
    const LightSpace plain = plain_space(), six_faces = space_of_point_among(shapes);
    REQUIRE(six_faces.face_count() == 6);
    for (const auto& [space, paper] :
         {std::pair{plain, false}, {plain, true}, {six_faces, false}}) {
        std::vector<float> opaque(std::size_t(space.width_px()) * space.height_px(), 1.f);
        for (std::size_t i = 0; i < opaque.size(); i += 3) opaque[i] = 0.4f;
        LightCasters casters;
        const FragmentSource source{casters, shapes, space, opaque, paper};
        const Texels bands = fragments_of(source), once = in_one_band(source);
        std::size_t count = 0;
        for (std::size_t texel = 0; texel < once.size(); ++texel) {
            REQUIRE(bands[texel].size() == once[texel].size());
            for (std::size_t i = 0; i < once[texel].size(); ++i) {
                const Fragment &a = bands[texel][i], &b = once[texel][i];
                REQUIRE(std::tie(a.x, a.y, a.texel, a.depth, a.optical_depth) ==
                        std::tie(b.x, b.y, b.texel, b.depth, b.optical_depth));
                REQUIRE(a.texel == std::size_t(a.y) * space.width_px() + a.x);
                REQUIRE((a.depth >= 0.f && a.depth <= opaque[texel]));
            }
            count += once[texel].size();
        }
        CHECK(count > 5000);
    }
}

TEST_CASE("a packed sample has each texel of its blocks once, in the order of the map") {
    for (const int stride : {1, 2, 7})
        for (const int side_px : {1, 57, 99, 100}) {
            const BlockSample sample{stride};
            int next = 0;
            for (int i = 0; i < side_px; ++i) {
                if (!sample.holds(i)) continue;
                CHECK(sample.packed(i) == next);
                CHECK(sample.unpacked(next) == i);
                ++next;
            }
            CHECK(sample.packed_px(side_px) == next);
        }
}

TEST_CASE("of a sample's texels fragments are those of all, and no others arrive") {
    const LightSpace space = plain_space();
    const std::vector<ShapePtr> shapes = tangle();
    LightCasters casters;
    FragmentSource source{casters, shapes, space, {}};
    const Texels all = fragments_of(source);
    source.sample = {3};
    const Texels some = fragments_of(source);
    for (std::size_t texel = 0; texel < all.size(); ++texel) {
        const bool held = source.sample.holds(int(texel % size_px), int(texel / size_px));
        CHECK(optical_depth_sum(some[texel]) == (held ? optical_depth_sum(all[texel]) : 0.0));
    }
}

TEST_CASE("a layer is the last whose plane is not behind, also among equal planes") {
    const std::vector<float> planes{0.f, 0.25f, 0.25f, 0.5f, 0.5f, 0.75f, 1.f};
    for (const float x : {0.f, 0.1f, 0.25f, 0.3f, 0.5f, 0.6f, 0.75f, 0.9f, 1.f}) {
        int last = 0;
        for (int k = 1; k + 1 < int(planes.size()); ++k)
            if (planes[std::size_t(k)] <= x) last = k;
        CHECK(layer_of(planes, x) == last);
        for (int k = 0; k < int(planes.size()); ++k)
            CHECK(counted_at(planes, k, x, x) == (k > last ? 1.f : 0.f));
    }
    CHECK(layer_of(std::vector<float>{0.f, 1.f}, 0.7f) == 0);
}

// The middle of the fan lies anywhere, some corners on the middles and edges of texels.
TEST_CASE("triangles that share edges cover each texel's middle once") {
    Random random;
    const LightSpace space = plain_space();
    for (int fan = 0; fan < 60; ++fan) {
        const int count = 3 + fan % 9;
        const auto snap = [&](double v) { return float(fan % 3 ? v : std::round(2.0 * v) / 2.0); };
        const float4 middle{snap(random(50, 78)), snap(random(50, 78)), 0.5f, 0.f};
        std::vector<float4> ring;
        for (int i = 0; i < count; ++i) {
            const double angle = 2.0 * std::numbers::pi * i / count, radius = random(25, 45);
            ring.push_back({snap(middle[0] + radius * std::cos(angle)),
                            snap(middle[1] + radius * std::sin(angle)), 0.5f, 0.f});
        }
        std::vector<int> covered(std::size_t(size_px) * size_px);
        for (int i = 0; i < count; ++i) {
            std::array<float4, 3> corners{middle, ring[i], ring[(i + 1) % count]};
            if (i % 2) std::swap(corners[1], corners[2]);  // seen from behind
            triangle_texels(corners, space, {0, size_px}, [&](const TriangleTexel& texel) {
                ++covered[std::size_t(texel.y) * size_px + texel.x];
                REQUIRE(std::abs(texel.weights[0] + texel.weights[1] + texel.weights[2] - 1.f) <
                        1e-5f);
            });
        }
        CHECK(*std::ranges::max_element(covered) == 1);
        for (int y = 0; y < size_px; ++y)  // no holes: within the ring all are covered
            for (int x = 0; x < size_px; ++x)
                if (std::hypot(x + 0.5 - middle[0], y + 0.5 - middle[1]) < 25 * std::cos(1.05))
                    REQUIRE(covered[std::size_t(y) * size_px + x] == 1);
    }
}

TEST_CASE("kernels integrate to 1, fall from the middle on, and are symmetric") {
    for (const FilterKernel kernel :
         {FilterKernel::box, FilterKernel::bartlett, FilterKernel::gaussian})
        for (const float radius : {0.5f, 2.f, 7.5f}) {
            const double width = 1.0 / 64;
            double sum = 0.0, last = INFINITY;
            for (int i = 0; i * width < radius; ++i) {
                // filter_weight is of a texel: the part of a kernel 64 times as wide.
                const float begin = float(i), wide = float(radius / width);
                const double weight = filter_weight(kernel, begin, wide);
                CHECK(weight == Approx(filter_weight(kernel, -begin - 1.f, wide)).epsilon(1e-4));
                REQUIRE(weight <= last * (1.0 + 1e-3) + 1e-7);
                last = weight;
                sum += 2.0 * weight;
            }
            CHECK(sum == Approx(1.0).epsilon(1e-5));
            CHECK(filter_weight(kernel, radius, radius) == 0.f);
            CHECK(filter_weight(kernel, -radius - 1.f, radius) == 0.f);
        }
    // Closed forms at radius 1, of the half texel beside the middle.
    CHECK(filter_sum(FilterKernel::box, 0.5f) == 0.75f);
    CHECK(filter_sum(FilterKernel::bartlett, 0.5f) == 0.875f);
    const double edge = std::erf(std::numbers::sqrt2);
    CHECK(filter_sum(FilterKernel::gaussian, 0.5f) ==
          Approx(0.5 + 0.5 * std::erf(1.0 / std::numbers::sqrt2) / edge).epsilon(1e-6));
}
