// Chunks of neighbours: every primitive lies in the box of one, boxes are small, and what a view
// sees of them follows the shape and the view.
#include "scene/primitive_chunks.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <random>
#include <vector>

#include "opacity/graph/view.hpp"
#include "opacity/scene/mesh.hpp"
#include "opacity/scene/particles.hpp"
#include "opacity/scene/strands.hpp"
#include "scene/primitives.hpp"

using namespace opacity;

namespace {

constexpr std::size_t count = 5 * PrimitiveChunks::size + 7;

std::vector<double> scattered(std::size_t numbers, unsigned seed = 1) {
    std::mt19937 engine{seed};
    std::uniform_real_distribution<double> place{0.0, 1.0};
    std::vector<double> xyz(numbers);
    std::generate(xyz.begin(), xyz.end(), [&] { return place(engine); });
    return xyz;
}

// Short pieces, stored in no order.
ShapePtr of_kind(int kind) {
    const std::size_t corners = kind == 0 ? 1 : kind == 1 ? 2 : 3;
    const std::vector<double> middles = scattered(3 * count), steps = scattered(9 * count, 2);
    std::vector<double> xyz;
    for (std::size_t i = 0; i < count * corners; ++i)
        for (std::size_t axis = 0; axis < 3; ++axis)
            xyz.push_back(middles[3 * (i / corners) + axis] + 0.01 * steps[3 * i + axis]);
    if (kind == 0) return std::make_shared<Particles>(Positions{xyz}, std::vector{0.01f});
    if (kind == 1) {
        std::vector<std::int64_t> offsets(count + 1);
        for (std::size_t k = 0; k <= count; ++k) offsets[k] = std::int64_t(2 * k);
        return std::make_shared<Strands>(Positions{xyz}, offsets);
    }
    std::vector<std::uint32_t> triangles(3 * count);
    std::iota(triangles.begin(), triangles.end(), 0u);
    return std::make_shared<Mesh>(Positions{xyz}, triangles);
}

double volume(const Box& box) {
    double product = 1.0;
    for (std::size_t axis = 0; axis < 3; ++axis) product *= box.max[axis] - box.min[axis];
    return product;
}

}  // namespace

TEST_CASE("each primitive is in one chunk, and within its box") {
    for (int kind = 0; kind < 3; ++kind) {
        const ShapePtr shape = of_kind(kind);
        const auto chunks = shape->chunks();
        const Primitives primitives{*shape};
        CHECK(primitives.count() == count);
        CHECK(chunks->count() == 6);
        std::vector<std::uint32_t> sorted = *chunks->order;
        std::sort(sorted.begin(), sorted.end());
        CHECK(sorted.size() == count);
        CHECK(std::adjacent_find(sorted.begin(), sorted.end()) == sorted.end());
        CHECK(sorted.back() == count - 1);
        double volumes = 0.0;
        bool all_within = true;
        for (std::size_t chunk = 0; chunk < chunks->count(); ++chunk) {
            Box box = chunks->boxes[chunk];
            volumes += volume(box);
            for (std::size_t i = chunks->first(chunk); i < chunks->first(chunk + 1); ++i)
                for (std::size_t corner = 0; corner < primitives.corners(); ++corner)
                    box.extend(shape->points()[primitives.point((*chunks->order)[i], corner)]);
            all_within &= box == chunks->boxes[chunk];
        }
        CHECK(all_within);
        CHECK(volumes < 3.0);  // of 6, were they not neighbours
    }
}

TEST_CASE("points that move leave the order, and make the boxes anew") {
    const ShapePtr shape = of_kind(1), twin = shape->instance();
    const auto before = shape->chunks();
    CHECK(twin->chunks() == before);
    std::vector<double> moved = scattered(6 * count);
    for (double& number : moved) number += 10.0;
    shape->set_points(Positions{moved});
    const auto after = shape->chunks();
    CHECK(after->order == before->order);
    CHECK(after->order_revision == before->order_revision);
    CHECK(after->boxes[0].min[0] >= 10.0);
    CHECK(twin->chunks() == before);
    CHECK(shape->chunks() == after);
}

TEST_CASE("a view finds what it sees again when it or the shape has moved") {
    const ShapePtr shape = of_kind(1);
    View view{"camera"};
    int asked = 0;
    double edge = 0.5;
    const auto cull = [&] {
        asked = 0;
        view.cull({shape}, [&](const Box& box, double reach) {
            ++asked;
            return box.min[0] - reach > edge;
        });
    };
    CHECK(view.seen(*shape) == nullptr);
    cull();
    CHECK(asked == 6);
    const View::ChunkCount half = view.chunks({shape});
    CHECK(half.all == 6);
    CHECK(half.hidden > 0);
    CHECK(half.hidden < 6);
    std::size_t seen = 0, last = 0;
    for (const ChunkRange& range : *view.seen(*shape)) {
        CHECK((seen == 0 || range.begin > last));  // else one range
        seen += range.end - range.begin;
        last = range.end;
    }
    CHECK(seen == 6 - half.hidden);
    cull();
    CHECK(asked == 0);
    edge = -1.0;
    view.update(identity, {{"u_moved", 1.f}});
    cull();
    CHECK(view.seen(*shape)->empty());
    shape->set_transform({1, 0, 0, -9, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1});
    cull();
    CHECK(view.chunks({shape}).hidden == 0);
    view.see_all();
    CHECK(view.seen(*shape) == nullptr);
}
