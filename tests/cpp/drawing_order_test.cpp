// What a camera's pass draws comes with what hides others first; what a light's pass draws as it is
// stored.
#include "render/drawing_order.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

#include "opacity/scene/mesh.hpp"
#include "opacity/scene/strands.hpp"

using namespace opacity;
using namespace opacity::render;

namespace {

ShapePtr triangle() {
    return std::make_shared<Mesh>(Positions{std::vector<double>{0, 0, 0, 1, 0, 0, 0, 1, 0}},
                                  std::vector<std::uint32_t>{0, 1, 2});
}

// Short strands side by side along x.
ShapePtr comb(std::size_t count = 1) {
    std::vector<double> xyz;
    std::vector<std::int64_t> offsets{0};
    for (std::size_t i = 0; i < count; ++i) {
        xyz.insert(xyz.end(), {double(i), 0, 0, double(i), 0.5, 0});
        offsets.push_back(std::int64_t(2 * i + 2));
    }
    return std::make_shared<Strands>(Positions{xyz}, offsets);
}

double distance(const PrimitiveChunks& chunks, std::size_t chunk, const double3& eye) {
    const double3 p = chunks.boxes[chunk].center();
    return std::hypot(p[0] - eye[0], p[1] - eye[1], p[2] - eye[2]);
}

double4x4 moved_by(const double3& offset) {
    double4x4 m = identity;
    for (std::size_t row = 0; row < 3; ++row) m[4 * row + 3] = offset[row];
    return m;
}

}  // namespace

TEST_CASE("a camera's pass draws strands before bodies, any other as they come") {
    DrawList shapes{"shapes"};
    shapes.update({triangle(), comb(), triangle(), comb()});
    View camera{"camera"}, light{"light"};
    camera.look_from_origin();
    Pass pass{.name = "lighting", .draws = &shapes, .view = &camera};
    pass.state = {.depth = Depth::greater, .clear_depth = 0.f};
    CHECK(drawing_order(pass) == std::vector<std::size_t>{1, 3, 0, 2});
    pass.view = &light;
    CHECK(drawing_order(pass) == std::vector<std::size_t>{0, 1, 2, 3});
    pass.view = &camera;
    pass.state.blend = Blend::over;  // the order is part of the picture
    CHECK(drawing_order(pass) == std::vector<std::size_t>{0, 1, 2, 3});
}

TEST_CASE("chunks come the nearest first, each that is seen once") {
    const ShapePtr shape = comb(8 * PrimitiveChunks::size);
    const auto lock = shape->lock();
    const auto chunks = shape->chunks();
    const double3 eye{3000.0, 10.0, 20.0};
    const ChunkRanges seen{{0, 3}, {5, chunks->count()}};
    const double4x4 view_from_local = moved_by({-eye[0], -eye[1], -eye[2]});
    std::vector<bool> found(chunks->count());
    double before = 0.0;
    for (const ChunkRange& range : front_to_back(*chunks, seen, view_from_local))
        for (std::size_t chunk = range.begin; chunk < range.end; ++chunk) {
            CHECK_FALSE(found[chunk]);
            found[chunk] = true;
            CHECK(distance(*chunks, chunk, eye) >= before);
            before = distance(*chunks, chunk, eye);
        }
    CHECK(found == std::vector<bool>{true, true, true, false, false, true, true, true});
}
