// The map of a light: what casts lies in it, at the resolution that there is, wherever the world's
// origin lies; and light space moves only if the map does.
#include "scene/light_fit.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <map>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "opacity/scene/mesh.hpp"
#include "opacity/scene/strands.hpp"

using namespace opacity;
using doctest::Approx;

namespace {

constexpr int map_sizes[] = {1, 2, 3, 4, 64, 512};

double dot(const double3& a, const double3& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
double3 row(const double4x4& m, int i) {
    const std::size_t at = std::size_t(4 * i);
    return {m[at], m[at + 1], m[at + 2]};
}

std::string text(const double3& v) {
    return std::to_string(v[0]) + " " + std::to_string(v[1]) + " " + std::to_string(v[2]);
}

class Random {
   public:
    double operator()(double low, double high) {
        return low + (high - low) * double(engine_()) / 4294967295.0;
    }
    double3 vector(double low, double high) {
        const double x = (*this)(low, high), y = (*this)(low, high);
        return {x, y, (*this)(low, high)};
    }

   private:
    std::mt19937 engine_{5};
};

// The axes both ways, next to an axis, diagonal, and anyhow; any length.
std::vector<double3> directions() {
    std::vector<double3> result{{1, 1, 1},      {-1e-9, 1, 1e-9}, {1e-200, 0, -1e-200},
                                {0, 3e5, 4},    {0.5, 0.3, -0.8}, {1, 1 + 1e-15, 1},
                                {1e-17, 0, -1}, {-0.5, 0.5, 1e-8}};
    for (int axis = 0; axis < 3; ++axis)
        for (const double sign : {1.0, -1.0}) {
            double3 direction{};
            direction[std::size_t(axis)] = sign;
            result.push_back(direction);
        }
    Random random;
    for (int i = 0; i < 20; ++i) result.push_back(random.vector(-1, 1));
    return result;
}

// Turned, sheared, mirrored and scaled by another factor along each axis.
double4x4 crooked(Random& random) {
    double4x4 m = identity;
    for (const std::size_t row : {0u, 4u, 8u})
        for (std::size_t column = 0; column < 4; ++column) m[row + column] = random(-2, 2);
    return m;
}

std::vector<double> scattered(Random& random, int points, double3 center = {}) {
    std::vector<double> xyz;
    for (int i = 0; i < points; ++i)
        for (std::size_t axis = 0; axis < 3; ++axis) xyz.push_back(center[axis] + random(-1, 1));
    return xyz;
}

std::shared_ptr<Strands> strands(std::vector<double> xyz, std::vector<float> width = {0.01f}) {
    const auto count = std::int64_t(xyz.size() / 3);
    return std::make_shared<Strands>(Positions{std::move(xyz)}, std::vector<std::int64_t>{0, count},
                                     std::move(width));
}
std::shared_ptr<Strands> tuft(double3 center, int seed = 1) {
    Random random;
    for (int i = 0; i < seed; ++i) random(0, 1);
    return strands(scattered(random, 12, center));
}
std::shared_ptr<Mesh> mesh(std::vector<double> xyz) {
    std::vector<std::uint32_t> triangles;
    for (std::uint32_t i = 0; i + 2 < xyz.size() / 3; ++i)
        triangles.insert(triangles.end(), {i, i + 1, i + 2});
    return std::make_shared<Mesh>(Positions{std::move(xyz)}, triangles);
}
// A square across z that receives and does not cast.
std::shared_ptr<Mesh> ground(double height, double half_size, double x = 0) {
    const double s = half_size, z = height;
    auto square = mesh({x - s, -s, z, x + s, -s, z, x - s, s, z, x + s, s, z});
    square->set_casts(false);
    return square;
}

Scene scene_of(const std::vector<ShapePtr>& shapes) {
    Scene scene;
    for (const ShapePtr& shape : shapes) scene.add(shape);
    return scene;
}

// Strands with a width a point and a mesh, each under a transform.
Scene tangle(Random& random) {
    std::vector<float> width;
    for (int i = 0; i < 30; ++i) width.push_back(float(random(0, 0.4)));
    const ShapePtr hair = strands(scattered(random, 30), width), body = mesh(scattered(random, 9));
    hair->set_transform(crooked(random));
    body->set_transform(crooked(random));
    return scene_of({hair, body});
}

// A fit, and the light space that it found last.
struct Map {
    LightSpace space;
    LightFit fit;

    Map() = default;
    Map(const Scene& scene, const double3& direction, int size_px, const Box& query = {}) {
        update(scene, DirectionalLight{direction}, size_px, query);
    }
    void update(const Scene& scene, const DirectionalLight& light, int size_px,
                const Box& query = {}) {
        space = fit.fit(
            scene, light, [size_px](double) { return size_px; }, query);
    }

    double texel_size() const { return 1.0 / space.texels_per_unit; }
    double depth_range() const { return space.depth_range; }
    double3 light_space(const double3& world) const {
        return transform_point(space.from_world, world);
    }
    // What the points of a shape cover in light space, half of their width included in x and y.
    Box covered_by(const Shape& shape) const {
        Box box;
        const auto* hair = dynamic_cast<const Strands*>(&shape);
        for (std::size_t i = 0; i < shape.points().size(); ++i) {
            const double3 p = light_space(transform_point(shape.transform(), shape.points()[i]));
            const double width = hair ? hair->width()[hair->width().size() > 1 ? i : 0] : 0.0;
            const double half = 0.5 * width * shape.scale() / texel_size();
            box.extend(double3{p[0] - half, p[1] - half, p[2]});
            box.extend(double3{p[0] + half, p[1] + half, p[2]});
        }
        return box;
    }
    Box covered_by(const Scene& scene, Box box = {}) const {
        for (const ShapePtr& shape : scene.shapes()) box.extend(covered_by(*shape));
        return box;
    }
};

bool finite(const double4x4& m) {
    for (const double element : m)
        if (!std::isfinite(element)) return false;
    return true;
}

}  // namespace

TEST_CASE("every caster lies in the map with its width, and leaves the border texel free") {
    Random random;
    for (const double3& direction : directions()) {
        const Scene scene = tangle(random);
        for (const int size_px : map_sizes) {
            CAPTURE(text(direction));
            CAPTURE(size_px);
            const Map map{scene, direction, size_px};
            const Box box = map.covered_by(scene);
            const double border = size_px >= 4 ? 1.0 : 0.0, rounding = 1e-6 * size_px;
            for (const std::size_t axis : {0u, 1u}) {
                CHECK(box.min[axis] >= border - rounding);
                CHECK(box.max[axis] <= size_px - border + rounding);
            }
            CHECK(box.min[2] >= -1e-12);
            CHECK(box.max[2] <= 1.0 + 1e-12);
        }
    }
}

TEST_CASE("the casters fill the map one way, and the first of them lies at depth 0") {
    Random random;
    for (const double3& direction : directions()) {
        const auto body = mesh(scattered(random, 12));
        body->set_transform(crooked(random));
        for (const int size_px : map_sizes) {
            const Map map{scene_of({body}), direction, size_px};
            const Box box = map.covered_by(*body);
            const double used = std::max(box.max[0] - box.min[0], box.max[1] - box.min[1]);
            CHECK(used == Approx(size_px >= 4 ? size_px - 2.0 : size_px));
            CHECK(0.5 * (box.min[0] + box.max[0]) == Approx(0.5 * size_px));
            CHECK(0.5 * (box.min[1] + box.max[1]) == Approx(0.5 * size_px));
            CHECK(std::abs(box.min[2]) < 1e-12);
        }
    }
}

TEST_CASE("texels are square, and depth is the distance along the light") {
    Random random;
    for (const double3& direction : directions()) {
        const Scene scene = tangle(random);
        const DirectionalLight light{direction};
        const Map map{scene, direction, 64};
        const double4x4& m = map.space.from_world;
        const double3 x = row(m, 0), y = row(m, 1), z = row(m, 2);
        const double texels = std::sqrt(dot(x, x)), depth = std::sqrt(dot(z, z));
        CHECK(std::sqrt(dot(y, y)) == Approx(texels).epsilon(1e-12));
        CHECK(std::abs(dot(x, y)) < 1e-12 * texels * texels);
        CHECK(std::abs(dot(x, z)) < 1e-12 * texels * depth);
        CHECK(std::abs(dot(y, z)) < 1e-12 * texels * depth);
        CHECK(dot(z, light.direction()) == Approx(depth).epsilon(1e-12));
        CHECK(map.texel_size() == Approx(1.0 / texels).epsilon(1e-6));
        CHECK(map.depth_range() == Approx(1.0 / depth).epsilon(1e-6));
        CHECK(map.space.map_size_px == 64);
    }
}

TEST_CASE("a wide ground that only receives takes no texel from the casters") {
    const auto hair = tuft({0, 0, 3});
    const Map alone{scene_of({hair}), {0.5, 0.3, -0.8}, 64};
    const Map grounded{scene_of({hair, ground(0.0, 1e4)}), {0.5, 0.3, -0.8}, 64};
    CHECK(grounded.space.from_world == alone.space.from_world);
    CHECK(grounded.depth_range() == alone.depth_range());
}

TEST_CASE("casters that no receiver can see leave the map, and those in front of one stay") {
    const auto hair = tuft({0, 0, 0}), beside = tuft({100, 0, 0}, 2), behind = tuft({0, 0, -50}, 3),
               in_front = tuft({0, 0, 50}, 4);
    for (const auto& caster : {beside, behind, in_front}) caster->set_receives(false);
    const double3 down{0, 0, -1};
    const Map alone{scene_of({hair}), down, 64};

    const Map cropped{scene_of({hair, beside}), down, 64};
    CHECK(cropped.texel_size() == Approx(alone.texel_size()).epsilon(0.02));
    const Map short_range{scene_of({hair, behind}), down, 64};
    CHECK(short_range.depth_range() == Approx(alone.depth_range()).epsilon(0.02));

    const Scene tall = scene_of({hair, in_front});
    const Map map{tall, down, 64};
    CHECK(map.depth_range() > 49.0);
    CHECK(map.covered_by(tall).min[2] >= -1e-12);
    CHECK(map.covered_by(tall).max[2] <= 1.0 + 1e-12);
}

TEST_CASE("whatever receives, texels get no larger than the casters alone would have them") {
    const double3 down{0, 0, -1};
    for (const double size : {1e-6, 1e-3, 1.0, 1e3}) {
        double4x4 scaled = identity;
        scaled[0] = scaled[5] = scaled[10] = size;
        const auto hair = tuft({0, 0, 0});
        hair->set_transform(scaled);
        const double alone = Map{scene_of({hair}), down, 64}.texel_size();
        hair->set_receives(false);
        // Beside the casters, in front of them, and in their shadow.
        for (const auto& [x, z] : {std::pair{3.0, -3.0}, {0.0, 3.0}, {0.0, -3.0}, {1.0, -3.0}}) {
            CAPTURE(text({x, z, size}));
            const Scene scene = scene_of({hair, ground(size * z, size, size * x)});
            CHECK(Map{scene, down, 64}.texel_size() <= alone * 1.0001);
        }
    }
}

TEST_CASE("points that are asked about widen the map again") {
    const auto hair = tuft({0, 0, 0}), beside = tuft({100, 0, 0}, 2);
    beside->set_receives(false);
    const Scene scene = scene_of({hair, beside});
    const double3 down{0, 0, -1};
    const Map asked{scene, down, 64, beside->bounds()};
    beside->set_receives(true);
    const Map received{scene, down, 64};
    CHECK(asked.space.from_world == received.space.from_world);
    const Box box = asked.covered_by(scene);
    CHECK(box.min[0] >= 1.0 - 1e-6);
    CHECK(box.max[0] <= 63.0 + 1e-6);

    // One point behind all that receives lengthens the range to the casters in front of it.
    const auto deep = tuft({0, 0, -50}, 3);
    deep->set_receives(false);
    const Box point{{0, 0, -60}, {0, 0, -60}};
    CHECK(Map{scene_of({hair, deep}), down, 64, point}.depth_range() > 49.0);
}

TEST_CASE("light space moves only if the map does") {
    const auto hair = tuft({0, 0, 0}), hidden = tuft({5, 5, 5}, 2);
    const auto floor = ground(-2, 1e3);
    hidden->set_casts(false);
    hidden->set_receives(false);
    const Scene scene = scene_of({hair, hidden, floor});
    DirectionalLight light{{0.5, 0.3, -0.8}};
    Map map;
    map.update(scene, light, 64);
    const LightSpace before = map.space;
    const auto moves = [&] {
        const LightSpace last = map.space;
        map.update(scene, light, 64);
        return map.space != last;
    };
    double4x4 shifted = identity;
    shifted[3] = 0.125;
    CHECK_FALSE(moves());
    hidden->set_transform(shifted);  // neither casts nor receives
    CHECK_FALSE(moves());
    floor->set_transform(shifted);  // still receives all that is cast
    CHECK_FALSE(moves());
    light.set_direction({0.5, 0.3, -0.8});
    CHECK_FALSE(moves());
    light.set_color({1, 0, 0});
    hair->set_color({{0, 1, 0}});
    hair->set_opacity({0.9f});
    CHECK_FALSE(moves());
    CHECK(map.space == before);

    hair->set_transform(shifted);
    CHECK(moves());
    light.set_direction({0.5, 0.3, -0.81});
    CHECK(moves());
    hair->set_opacity({0.f});  // casts nothing any more
    CHECK(moves());
}

TEST_CASE("far from the origin, light space is the same to a ten thousandth of a texel") {
    Random random;
    std::vector<double> near;  // multiples of 1/1024: exact in float64 after every move below
    for (int i = 0; i < 60; ++i) near.push_back(std::round(1024.0 * random(-1, 1)) / 1024.0);
    for (const double3& direction : directions()) {
        const Map reference{scene_of({strands(near)}), direction, 512};
        for (const double far : {1e3, 1e4, 1e5, 1e6, 1e7, -1e7}) {
            const double3 move{far, -0.5 * far, 0.25 * far};
            std::vector<double> xyz = near;
            for (std::size_t i = 0; i < xyz.size(); ++i) xyz[i] += move[i % 3];
            const auto by_points = strands(xyz), by_transform = strands(near);
            by_transform->set_transform(
                {1, 0, 0, move[0], 0, 1, 0, move[1], 0, 0, 1, move[2], 0, 0, 0, 1});
            for (const auto& moved : {by_points, by_transform}) {
                const Map map{scene_of({moved}), direction, 512};
                double worst_texel = 0.0, worst_depth = 0.0;
                for (std::size_t i = 0; i < near.size() / 3; ++i) {
                    const double3 p =
                        reference.light_space({near[3 * i], near[3 * i + 1], near[3 * i + 2]});
                    const double3 q = map.light_space({xyz[3 * i], xyz[3 * i + 1], xyz[3 * i + 2]});
                    worst_texel =
                        std::max({worst_texel, std::abs(p[0] - q[0]), std::abs(p[1] - q[1])});
                    worst_depth = std::max(worst_depth, std::abs(p[2] - q[2]));
                }
                CAPTURE(text(direction));
                CAPTURE(far);
                CHECK(worst_texel < 1e-4);
                CHECK(worst_depth < 1e-7);
            }
        }
    }
}

TEST_CASE("nothing, a point and a line along the light still give a map") {
    const auto line = [](const double3& d, double length, const double3& at) {
        std::vector<double> xyz;
        for (int i = 0; i < 5; ++i)
            for (std::size_t axis = 0; axis < 3; ++axis)
                xyz.push_back(at[axis] + length * i * d[axis]);
        return xyz;
    };
    for (const double3& direction : directions()) {
        const double3 d = DirectionalLight{direction}.direction();
        std::vector<Scene> scenes(1);
        for (const double at : {0.0, 1e-20, 1.0, -1e7, 1e17})
            for (const double length : {0.0, 1e-12, 1.0, 1e17})
                for (const float width : {0.f, 1e-6f, 1.f}) {
                    const std::vector<double> xyz = line(d, length, {at, 2 * at, -at});
                    scenes.push_back(scene_of({strands(xyz, {width})}));
                    if (width == 0.f) scenes.push_back(scene_of({mesh(xyz)}));
                }
        scenes.push_back(scene_of({strands({0, 0, 0})}));
        for (const Scene& scene : scenes)
            for (const int size_px : map_sizes) {
                const Map map{scene, direction, size_px};
                CHECK(finite(map.space.from_world));
                // Shaders take them as float32.
                for (const double value :
                     {map.space.depth_range, map.space.texels_per_unit, map.space.least_bias}) {
                    CHECK(std::isfinite(float(value)));
                    CHECK(float(value) > 0.f);
                }
            }
    }
}
