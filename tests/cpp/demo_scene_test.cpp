#include <doctest/doctest.h>

#include <cstdint>
#include <string>

#include "opacity/core/error.hpp"
#include "opacity/io/load.hpp"
#include "scratch_folder.hpp"
#include "shape_hash.hpp"

using namespace opacity;

namespace {

std::uint64_t hash(const std::string& request) {
    return ShapeHash{}.of(load(request));
}

// How many of what scenes count: a volume's are voxels, and a mesh with holes is one of leaves.
std::size_t count(const std::vector<ShapePtr>& shapes) {
    std::size_t sum = 0;
    for (const ShapePtr& shape : shapes) {
        if (const auto* strands = dynamic_cast<Strands*>(shape.get()))
            sum += strands->segments().size();
        if (const auto* volume = dynamic_cast<Volume*>(shape.get())) sum += volume->voxel_count();
        if (const auto* mesh = dynamic_cast<Mesh*>(shape.get()))
            sum += mesh->has_alpha() ? mesh->triangles().size() / 6 : 0;
        if (dynamic_cast<Particles*>(shape.get())) sum += shape->points().size();
    }
    return sum;
}

struct Scene {
    std::string name, primitive;
    std::uint64_t small_hash;  // of a thousand
};
const Scene scenes[] = {
    {"hair", "segments", 2791785696705299806u},
    {"fur", "segments", 15072285627629442749u},
    {"grass", "segments", 16454464393197130104u},
    {"dense_grass", "segments", 8661533577214026717u},
    {"tree", "leaves", 1390405183173028520u},
    {"sparse_tree", "leaves", 18042437341010046146u},
    {"smoke", "voxels", 11318295509043531793u},
    {"clouds", "voxels", 6294674907010384628u},
    {"plume", "particles", 11429347468370718908u},
    {"teapot", "segments", 18349702768290536308u},
    {"mixed", "primitives", 17797218909402792216u},
};

std::string request(const Scene& scene, std::size_t how_many) {
    return "demo:" + scene.name + "?" + scene.primitive + "=" + std::to_string(how_many);
}

}  // namespace

TEST_CASE("every demo is the same bits on every machine, and others for another seed") {
    std::vector<std::string> names;
    for (const Scene& scene : scenes) {
        CAPTURE(scene.name);
        names.push_back(scene.name);
        CHECK(hash(request(scene, 1000)) == scene.small_hash);
        CHECK(hash(request(scene, 1000) + "&seed=1") == scene.small_hash);
        CHECK(hash(request(scene, 1000) + "&seed=2") != scene.small_hash);
    }
    CHECK(names == demo_names());
    CHECK(hash("demo:hair?segments=1000&style=wavy") == scenes[0].small_hash);
    CHECK(hash("demo:hair?segments=1000&style=straight") == 1591771176673973951u);
    CHECK(hash("demo:hair?segments=1000&style=curly") == 13861708877374287032u);
}

// That all numbers are finite and in range, shapes see to themselves.
TEST_CASE("every demo has as many primitives as asked for") {
    for (const Scene& scene : scenes)
        for (const std::size_t wanted : {1, 7, 1000, 12'345, 200'000}) {
            CAPTURE(scene.name);
            CAPTURE(wanted);
            const std::size_t made = count(load(request(scene, wanted)));
            // A box of voxels has as many as whole layers allow.
            const std::size_t missing = scene.primitive != "voxels" ? 0
                                        : wanted < 1000             ? wanted / 2
                                                                    : wanted / 20;
            CHECK(made <= wanted);
            CHECK(made >= wanted - missing);
        }
}

TEST_CASE("every demo stands on a ground that only receives, and casts from above it") {
    for (const Scene& scene : scenes) {
        CAPTURE(scene.name);
        const auto shapes = load(request(scene, 20'000));
        REQUIRE(shapes.size() >= 2);
        const ShapePtr& ground = shapes.back();
        CHECK(ground->opaque());
        CHECK(!ground->casts());
        CHECK(ground->receives());
        for (std::size_t i = 0; i + 1 < shapes.size(); ++i) {
            CHECK(shapes[i]->is_caster());
            const Box box = shapes[i]->bounds(), floor = ground->bounds();
            const double height = box.max[2] - floor.max[2];
            CHECK(box.min[2] > floor.max[2] - 0.05 * height);
            CHECK(box.min[0] > floor.min[0]);
            CHECK(box.max[0] < floor.max[0]);
        }
    }
}

TEST_CASE("a demo's count and style are refused by name") {
    const auto refused = [](const std::string& name) {
        return message_of<ParameterError>([&] { load(name); });
    };
    for (const Scene& scene : scenes) {
        CAPTURE(scene.name);
        CHECK(contains(refused(request(scene, 0)), scene.primitive + " = \"0\""));
        CHECK(contains(refused(request(scene, 1'000'000'000)), "1.."));
        CHECK(contains(refused("demo:" + scene.name + "?number=3"), scene.primitive + ", seed"));
    }
    CHECK(contains(refused("demo:hair?style=curled"), "\"curly\""));
    CHECK(contains(refused("demo:hair?style="), "wavy, straight, curly"));
    CHECK(contains(refused("demo:fur?style=curly"), "segments, seed"));
    CHECK(contains(refused("demo:gras"), "\"grass\""));
}
