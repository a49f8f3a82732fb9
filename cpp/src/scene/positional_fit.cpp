#include "scene/positional_fit.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/vector.hpp"
#include "opacity/scene/mesh.hpp"
#include "scene/bias.hpp"
#include "scene/light_fit.hpp"

namespace opacity {
namespace {

// Casters within this tangent of a face's middle are better seen through one face than through the
// six of a cube, whose faces end at 1.
constexpr double widest_tangent = 2.0;
// As in light_fit.cpp.
constexpr double surface_margin_texels = 10.0;

// Forward along +z, -z, +x, -x, +y, -y; the first one's axes are the world's.
constexpr std::array<std::array<double, 9>, 6> cube_axes{{{1, 0, 0, 0, 1, 0, 0, 0, 1},
                                                          {-1, 0, 0, 0, 1, 0, 0, 0, -1},
                                                          {0, 0, -1, 0, 1, 0, 1, 0, 0},
                                                          {0, 0, 1, 0, 1, 0, -1, 0, 0},
                                                          {1, 0, 0, 0, 0, -1, 0, 1, 0},
                                                          {1, 0, 0, 0, 0, 1, 0, -1, 0}}};

std::array<double3, 8> corners(const Box& box) {
    std::array<double3, 8> result;
    for (std::size_t i = 0; i < 8; ++i)
        for (std::size_t axis = 0; axis < 3; ++axis)
            result[i][axis] = i >> axis & 1 ? box.max[axis] : box.min[axis];
    return result;
}

double nearest(const Box& box, const double3& p) {
    double3 outside{};
    for (std::size_t i = 0; i < 3; ++i)
        outside[i] = std::max({box.min[i] - p[i], p[i] - box.max[i], 0.0});
    return length(outside);
}
double farthest(const Box& box, const double3& p) {
    double most = 0.0;
    for (const double3& corner : corners(box)) most = std::max(most, length(minus(corner, p)));
    return most;
}

double3 seen_from(const double3& point, const double4x4& rotation, const double3& p) {
    const double3 r = transform_point(rotation, minus(p, point));
    return {r[0] / r[2], r[1] / r[2], r[2]};
}

bool is_before(const Box& box, const double3& point, const double3& forward) {
    return std::ranges::all_of(corners(box), [&](const double3& corner) {
        const double3 r = minus(corner, point);
        return dot(r, forward) > 1e-3 * length(r);
    });
}

// A widest tangent of a cone's square.
double tangent_of(const SpotLight& spot) {
    return std::tan(0.5 * spot.angle_deg() * std::numbers::pi / 180.0);
}

Window intersection(const Window& a, const Window& b) {
    Box box;
    for (std::size_t i = 0; i < 2; ++i) {
        box.min[i] = std::max(a.middle[i] - 0.5 * a.side, b.middle[i] - 0.5 * b.side);
        box.max[i] = std::min(a.middle[i] + 0.5 * a.side, b.middle[i] + 0.5 * b.side);
        if (box.min[i] > box.max[i]) return a;
    }
    return Window::around(box);
}

// Beside one face nothing casts; beside a cube's lie its neighbours, and the taps of a filter must
// find on one face what they need.
double border_px(int map_size_px, bool is_cube) {
    if (!is_cube) return map_size_px >= 4 ? 1.0 : 0.0;
    return map_size_px >= 8 ? std::clamp(map_size_px / 32.0, 2.0, 34.0) : 0.0;
}

struct Range {
    double near = 0.0, far = 1.0;
};

Range range_of(const Box& casters, const Box& receivers, const std::vector<double3>& points) {
    if (casters.empty()) return {};
    Range range{Box::infinity, 0.0};
    double last_receiver = 0.0;
    for (const double3& point : points) {
        range.near = std::min(range.near, nearest(casters, point));
        range.far = std::max(range.far, farthest(casters, point));
        if (!receivers.empty()) last_receiver = std::max(last_receiver, farthest(receivers, point));
    }
    if (last_receiver > range.near) range.far = std::min(range.far, last_receiver);
    return range;
}

}  // namespace

PositionalFit::Extent PositionalFit::measure(const Scene& scene) {
    Extent extent;
    for (const ShapePtr& shape : scene.shapes()) {
        const auto lock = shape->lock();
        if (shape->receives()) extent.receivers.extend(shape->bounds());
        if (!shape->is_caster()) continue;
        extent.casters.extend(shape->bounds());
        extent.surfaces |= dynamic_cast<const Mesh*>(shape.get()) != nullptr;
    }
    return extent;
}

std::optional<Box> PositionalFit::tangents(const Scene& scene, Lens& lens,
                                           const double3& point) const {
    CasterBoxes::Key key{point[0],        point[1],        point[2],
                         lens.forward[0], lens.forward[1], lens.forward[2]};
    const auto place = [&](const double3& p) { return seen_from(point, lens.rotation, p); };
    Box box;
    for (const ShapePtr& shape : scene.shapes()) {
        const auto lock = shape->lock();
        if (!shape->is_caster()) continue;
        if (!is_before(shape->bounds(), point, lens.forward)) return {};
        const Box& own = lens.boxes.box(*shape, key, place);
        const double steepest = std::max({std::abs(own.min[0]), std::abs(own.max[0]),
                                          std::abs(own.min[1]), std::abs(own.max[1])});
        const double pad = shape->margin() * shape->scale() / own.min[2];
        box.extend(own.padded(pad * (1.0 + steepest * steepest)));
    }
    return box;
}

// Whether each point sees all casters through one face, whose lens is then set.
bool PositionalFit::aim(const Scene& scene, const PositionalLight& light, const Extent& extent) {
    const auto* spot = dynamic_cast<const SpotLight*>(&light);
    lenses_.resize(points_.size());
    for (std::size_t i = 0; i < points_.size(); ++i) {
        Lens& lens = lenses_[i];
        lens.boxes.forget_absent(scene);
        const double reach = spot ? tangent_of(*spot) : widest_tangent;
        const Window all{{0.0, 0.0}, 2.0 * reach};
        std::optional<Box> box = tangents(scene, lens, points_[i]);
        const auto fits = [&] { return box && all.contains(Window::around(*box)); };
        const double3 ahead = spot ? spot->direction() : minus(extent.casters.center(), points_[i]);
        const bool turned = spot && spot->direction() != lens.forward;
        const bool held = !turned && lens.window && (spot || fits()) &&
                          (!box || lens.window->contains(Window::around(*box)));
        const double distance = length(ahead);
        if (!held && distance > 0.0) {
            lens.forward = {ahead[0] / distance, ahead[1] / distance, ahead[2] / distance};
            lens.rotation = light_rotation(lens.forward);
            box = tangents(scene, lens, points_[i]);
            lens.window = Window{};  // with room to move from the first
        }
        if (!spot && !fits()) return false;
        const Window needed = box ? intersection(Window::around(*box), all) : all;
        steady(lens.window, {needed.middle, std::max(needed.side, 1e-6)});
    }
    return true;
}

namespace {

// Where nothing casts: one face a point, which sees nothing.
LightSpace nothing_cast(const Scene& scene, int map_size_px, std::size_t points) {
    LightSpace space{.faces = std::vector<LightFace>(points)};
    space.map_size_px = map_size_px;
    space.least_bias = least_bias(scene);
    return space;
}

// A point's face, or one of its six, in light coordinates: those of the world about the casters'
// middle, in depth ranges.
LightFace face_at(const double3& point, const std::array<double, 9>& axes, const Window& window,
                  const FaceScale& scale) {
    LightFace face{.axes = axes};
    const double3 away = minus(scale.center, point);
    face.offset = face.seen(scaled(away, 1.0 / scale.depth_range));
    face.focal_px = scale.free_px / window.side;
    for (std::size_t i = 0; i < 2; ++i)
        face.middle_px[i] = 0.5 * scale.map_size_px - face.focal_px * window.middle[i];
    face.depth_of_origin = (length(away) - scale.near) / scale.depth_range;
    return face;
}

}  // namespace

// The widest window of all points.
double PositionalFit::widest_window() const {
    double widest = lenses_.empty() ? 2.0 : 0.0;
    for (const Lens& lens : lenses_) widest = std::max(widest, lens.window->side);
    return widest;
}

std::vector<LightFace> PositionalFit::faces(const FaceScale& scale) const {
    std::vector<LightFace> faces;
    if (lenses_.empty())
        for (const double3& point : points_)
            for (const auto& axes : cube_axes)
                faces.push_back(face_at(point, axes, {{0.0, 0.0}, 2.0}, scale));
    for (std::size_t i = 0; i < lenses_.size(); ++i) {
        const double4x4& m = lenses_[i].rotation;
        faces.push_back(face_at(points_[i], {m[0], m[1], m[2], m[4], m[5], m[6], m[8], m[9], m[10]},
                                *lenses_[i].window, scale));
    }
    return faces;
}

LightSpace PositionalFit::fit(const Scene& scene, const PositionalLight& light,
                              const MapSizePx& size_for, const Box& query) {
    points_ = light_points(light);
    Extent extent = measure(scene);
    extent.receivers.extend(query);
    if (extent.casters.empty()) return nothing_cast(scene, size_for(1.0), points_.size());
    if (!aim(scene, light, extent)) lenses_.clear();

    LightSpace space{.faces = {}};
    space.least_bias = least_bias(scene);
    const Range range = range_of(extent.casters, extent.receivers, points_);
    const double widest = widest_window();
    space.map_size_px = size_for(widest * 0.5 * (range.near + range.far));
    const double free_px = space.map_size_px - 2.0 * border_px(space.map_size_px, lenses_.empty());
    const double margin =
        extent.surfaces ? surface_margin_texels * range.far * widest / free_px : 0.0;
    space.depth_range = std::max({range.far - range.near, 1e-6 * range.far, 1e-30}) + margin;
    space.texels_per_unit = free_px / widest / space.depth_range;
    const double3 center = extent.casters.center();
    for (std::size_t i = 0; i < 3; ++i) {
        space.from_world[5 * i] = 1.0 / space.depth_range;
        space.from_world[4 * i + 3] = -center[i] / space.depth_range;
    }
    space.faces_an_eye = lenses_.empty() ? 6 : 1;
    space.faces = faces({center, range.near, space.depth_range, free_px, space.map_size_px});
    return space;
}

}  // namespace opacity
