#include "render/scene_lists.hpp"

#include <algorithm>
#include <cmath>

#include "opacity/scene/mesh.hpp"
#include "opacity/scene/strands.hpp"

namespace opacity::render {
namespace {

// What a ray meets the inside of: particles and volumes.
bool is_medium(const Shape& shape) {
    return !dynamic_cast<const Strands*>(&shape) && !dynamic_cast<const Mesh*>(&shape);
}

// To the light strands are never opaque, whose maps hold how much of a texel they cover.
bool looks_solid(const Shape& shape) {
    return shape.opaque() ||
           (dynamic_cast<const Strands*>(&shape) != nullptr && shape.min_opacity() >= 1.f);
}

bool covers_nothing(const Shape& shape) {
    return shape.invisible_to_light() || shape.points().size() == 0;
}

bool orders_itself(const Scene& scene) {
    int translucent = 0;
    for (const ShapePtr& shape : scene.shapes()) {
        const auto lock = shape->lock();
        if (looks_solid(*shape) || covers_nothing(*shape)) continue;
        if (++translucent > 1 || dynamic_cast<const Mesh*>(shape.get())) return false;
    }
    return true;
}

void sort_by_distance(std::vector<ShapePtr>& shapes, const double3& eye) {
    std::vector<std::pair<double, ShapePtr>> far;
    for (const ShapePtr& shape : shapes) {
        const auto lock = shape->lock();
        const double3 c = shape->bounds().center();
        far.emplace_back(std::hypot(c[0] - eye[0], c[1] - eye[1], c[2] - eye[2]), shape);
    }
    std::stable_sort(far.begin(), far.end(),
                     [](const auto& a, const auto& b) { return a.first > b.first; });
    std::transform(far.begin(), far.end(), shapes.begin(),
                   [](const auto& entry) { return entry.second; });
}

}  // namespace

Compositing compositing_of(const Choice& setting, const Scene& scene) {
    if (setting.is("opaque")) return Compositing::opaque;
    if (setting.is("subsets")) return Compositing::subsets;
    if (setting.is("exact")) return Compositing::exact;
    const bool sorts = setting.is("sorted") || (setting.is("auto") && orders_itself(scene));
    return sorts ? Compositing::sorted : Compositing::maps;
}

void SceneLists::update_casters(const Scene& scene) {
    std::vector<ShapePtr> translucent_casters, opaque_casters;
    for (const ShapePtr& shape : scene.shapes()) {
        const auto lock = shape->lock();
        if (!shape->is_caster()) continue;
        (shape->opaque() ? opaque_casters : translucent_casters).push_back(shape);
    }
    translucent.update(std::move(translucent_casters));
    opaque.update(std::move(opaque_casters));
}

void SceneLists::update_seen(const Scene& scene, Compositing compositing, const CameraView& view) {
    std::vector<ShapePtr> with_surface, solids, in_parts, blends;
    out_of_view = 0;
    for (const ShapePtr& shape : scene.shapes()) {
        const auto lock = shape->lock();
        if (is_out_of_view(view, shape->bounds())) {
            ++out_of_view;
            continue;
        }
        const bool medium = is_medium(*shape);
        if (!medium) with_surface.push_back(shape);
        if (compositing == Compositing::opaque && !medium)
            solids.push_back(shape);
        else if (looks_solid(*shape))
            solids.push_back(shape);
        else if (covers_nothing(*shape))
            continue;
        else if (compositing == Compositing::subsets && !medium)
            in_parts.push_back(shape);
        else
            blends.push_back(shape);
    }
    const bool in_order = compositing != Compositing::exact && compositing != Compositing::maps;
    if (in_order) sort_by_distance(blends, view.camera.eye());
    surfaces.update(std::move(with_surface));
    solid.update(std::move(solids));
    parted.update(std::move(in_parts));
    blended.update(std::move(blends));
}

}  // namespace opacity::render
