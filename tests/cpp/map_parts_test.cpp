// Maps that leave out chunks which they cannot hold have the same fragments; maps that hold fewer
// strands have those of these strands alone, as many times as wide.
#include <doctest/doctest.h>

#include <cmath>
#include <memory>
#include <numeric>
#include <random>
#include <tuple>
#include <vector>

#include "map/fragments.hpp"
#include "map/receiver.hpp"
#include "opacity/scene/mesh.hpp"
#include "opacity/scene/particles.hpp"
#include "opacity/scene/scene.hpp"
#include "opacity/scene/strands.hpp"
#include "scene/light_fit.hpp"
#include "scene/map_window.hpp"
#include "scene/primitive_chunks.hpp"
#include "scene/strand_ranks.hpp"

using namespace opacity;
using doctest::Approx;

namespace {

constexpr int size_px = 96, strand_points = 5;
constexpr std::size_t strand_count = 8000;

// Strands of four segments each, anywhere in a cube of side 2.
std::shared_ptr<Strands> fur(float width = 0.01f) {
    std::mt19937 engine{4};
    std::uniform_real_distribution<double> place{-1.0, 1.0};
    std::vector<double> xyz;
    std::vector<std::int64_t> offsets{0};
    for (std::size_t k = 0; k < strand_count; ++k) {
        double3 p{place(engine), place(engine), place(engine)};
        for (int i = 0; i < strand_points; ++i) {
            xyz.insert(xyz.end(), p.begin(), p.end());
            for (double& c : p) c += 0.05 * place(engine);
        }
        offsets.push_back(std::int64_t(xyz.size() / 3));
    }
    auto strands = std::make_shared<Strands>(Positions{xyz}, offsets, std::vector{width});
    strands->set_receives(false);
    return strands;
}

std::vector<ShapePtr> casters_of_all_kinds() {
    const auto strands = fur();
    std::vector<double> xyz;
    for (std::size_t i = 0; i < 3 * strand_count; ++i)
        for (const double c : strands->points()[i]) xyz.push_back(c);
    auto particles = std::make_shared<Particles>(Positions{xyz}, std::vector{0.02f});
    std::vector<std::uint32_t> triangles(3 * strand_count);
    std::iota(triangles.begin(), triangles.end(), 0u);
    auto mesh =
        std::make_shared<Mesh>(Positions{xyz}, triangles, std::vector<float3>{}, std::vector{0.5f});
    particles->set_receives(false);
    mesh->set_receives(false);
    return {strands, particles, mesh};
}

// What receives is small, so that the light's map may be.
LightSpace space_of(const std::vector<ShapePtr>& shapes, const Light& light) {
    Scene scene;
    for (const ShapePtr& shape : shapes) scene.add(shape);
    Box receivers;
    receivers.extend(double3{0.3, 0.2, -0.1});
    receivers.extend(double3{0.5, 0.4, 0.1});
    return LightFit{}.fit(
        scene, light, [](double) { return size_px; }, receivers);
}

std::vector<LightPtr> lights() {
    return {std::make_shared<DirectionalLight>(double3{0.2, 0.3, -1.0}),
            std::make_shared<SpotLight>(double3{0.0, 0.0, 5.0}, double3{0.1, 0.1, -1.0}, 3.0),
            std::make_shared<PointLight>(double3{4.0, 1.0, 2.0}),
            std::make_shared<PointLight>(double3{0.1, 0.1, 0.2})};
}

using Texels = std::vector<std::vector<Fragment>>;
Texels fragments_of(const FragmentSource& source) {
    Texels texels(std::size_t(source.space.width_px()) * source.space.height_px());
    for_each_fragment(source, [&](const Fragment& f) { texels[f.texel].push_back(f); });
    return texels;
}

std::size_t hidden_chunks(const Shape& shape, const LightSpace& space) {
    std::size_t count = 0;
    for (const Box& box : shape.chunks()->boxes)
        count += is_out_of_map(space, box, caster_reach(shape, space.strand_detail));
    return count;
}

// The strands that a map of this detail holds, as wide as it has them.
std::shared_ptr<Strands> held(const Strands& strands, double detail) {
    const auto ranks = strands.ranks();
    std::vector<double> xyz;
    std::vector<std::int64_t> offsets{0};
    for (std::size_t k = 0; k < strands.strand_count(); ++k) {
        if (!ranks->is_kept(k, detail)) continue;
        for (std::int64_t i = strands.offsets()[k]; i < strands.offsets()[k + 1]; ++i)
            for (const double c : strands.points()[std::size_t(i)]) xyz.push_back(c);
        offsets.push_back(std::int64_t(xyz.size() / 3));
    }
    const double widening = double(strands.strand_count()) / double(offsets.size() - 1);
    return std::make_shared<Strands>(Positions{xyz}, offsets,
                                     std::vector{float(strands.width()[0] * widening)});
}

}  // namespace

TEST_CASE("what is left out had no fragment in the map") {
    const std::vector<ShapePtr> shapes = casters_of_all_kinds();
    std::size_t hidden = 0;
    for (const LightPtr& light : lights())
        for (const double detail : {1.0, 0.1}) {
            LightSpace space = space_of(shapes, *light);
            space.strand_detail = detail;
            for (const ShapePtr& shape : shapes) hidden += hidden_chunks(*shape, space);
            LightCasters some, all;
            all.set_culling(false);
            const Texels culled = fragments_of({some, shapes, space, {}});
            const Texels forced = fragments_of({all, shapes, space, {}});
            std::size_t count = 0;
            for (std::size_t texel = 0; texel < forced.size(); ++texel) {
                REQUIRE(culled[texel].size() == forced[texel].size());
                for (std::size_t i = 0; i < forced[texel].size(); ++i) {
                    const Fragment &a = culled[texel][i], &b = forced[texel][i];
                    REQUIRE(std::tie(a.depth, a.depth_end, a.optical_depth) ==
                            std::tie(b.depth, b.depth_end, b.optical_depth));
                }
                count += forced[texel].size();
            }
            CHECK(count > 1000);
        }
    CHECK(hidden > 30);
}

TEST_CASE("a map of fewer strands is that of these strands, as many times as wide") {
    const auto strands = fur(0.003f);
    for (const LightPtr& light : lights())
        for (const double detail : {0.5, 0.13}) {
            const std::vector<ShapePtr> all{strands}, few{held(*strands, detail)};
            const LightSpace whole = space_of(all, *light);
            LightSpace space = whole;
            space.strand_detail = detail;
            LightCasters casters;
            const Texels found = fragments_of({casters, all, space, {}});
            const Texels right = fragments_of({casters, few, whole, {}});
            double off = 0.0, sum = 0.0;
            for (std::size_t texel = 0; texel < right.size(); ++texel) {
                double a = 0.0, b = 0.0;
                for (const Fragment& f : found[texel]) a += f.optical_depth;
                for (const Fragment& f : right[texel]) b += f.optical_depth;
                off += std::abs(a - b);
                sum += b;
            }
            CHECK(sum > 1.0);
            CHECK(off < 1e-3 * sum);  // each rounds about a middle of its own
        }
}

TEST_CASE("receivers know what the map holds of their strand") {
    const auto strands = fur();
    Scene scene;
    scene.add(strands);
    LightSpace space = space_of({strands}, *lights()[0]);
    const Query query = Query::at(*strands, scene);
    const std::vector<Receiver> as_they_are = receivers_in(space, query, true);
    space.strand_detail = 0.25;
    const std::vector<Receiver> now = receivers_in(space, query, true);
    const auto ranks = strands->ranks();
    for (std::size_t i = 0; i < now.size(); ++i) {
        const bool is_held = ranks->is_kept(i / strand_points, 0.25);
        REQUIRE(now[i].p_ls == as_they_are[i].p_ls);
        REQUIRE(now[i].opacity == (is_held ? as_they_are[i].opacity : 0.f));
        if (is_held)
            REQUIRE(now[i].width_texels == Approx(4.0 * as_they_are[i].width_texels).epsilon(1e-3));
    }
}
