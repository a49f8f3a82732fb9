#include "render/camera_maps.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "render/light_view.hpp"
#include "scene/map_window.hpp"

namespace opacity::render {
namespace {

// Single hairs are not to be told apart here: what counts is how much lies before a sample.
constexpr int largest_map_px = 512;

// World units: how near and how far what is drawn can be.
struct Distances {
    double nearest = 0.0, farthest = 0.0;
};

Distances distances(const Box& box, const double3& eye) {
    double nearest = 0.0, farthest = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
        const double before = box.min[axis] - eye[axis], behind = eye[axis] - box.max[axis];
        const double outside = std::max({before, behind, 0.0});
        nearest += outside * outside;
        const double most = std::max(-before, -behind);
        const double far = std::max(std::abs(before), std::abs(behind));
        farthest += std::max(most * most, far * far);
    }
    return {std::sqrt(nearest), std::sqrt(farthest)};
}

Box bounds_of(const DrawList& shapes) {
    Box box;
    for (const ShapePtr& shape : shapes.shapes()) {
        const auto lock = shape->lock();
        box.extend(shape->bounds());
    }
    return box;
}

// To the right, down and forward, in depth ranges.
double4x4 light_coordinates(const double4x4& view_from_world, double range) {
    double4x4 m = view_from_world;
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 4; ++column)
            m[4 * row + column] *= (row == 0 ? 1.0 : -1.0) / range;
    return m;
}

LightSpace camera_space(const PictureInputs& inputs) {
    const int width = inputs.settings.width.get(), height = inputs.settings.height.get();
    const Box box = bounds_of(inputs.lists.blended);
    const Distances seen = distances(box, inputs.camera.eye());
    const double range = std::max(seen.farthest - seen.nearest, 1e-6 * seen.farthest + 1e-30);
    LightSpace space;
    space.from_world = light_coordinates(inputs.camera.view_from_world(), range);
    space.map_size_px = std::clamp(std::max(width, height), 4, largest_map_px);
    space.depth_range = range;
    space.least_bias = std::max(1e-4 * box.radius(), 1e-30);
    const double half_height = std::tan(inputs.camera.fov_deg() * std::numbers::pi / 360.0);
    const double half_side = half_height * std::max(1.0, double(width) / height);
    LightFace face;
    face.focal_px = (0.5 * space.map_size_px - 1.0) / half_side;  // a texel of border
    face.middle_px = {0.5 * space.map_size_px, 0.5 * space.map_size_px};
    face.depth_of_origin = -seen.nearest / range;
    space.faces = {face};
    space.texels_per_unit = face.focal_px / range;
    return space;
}

}  // namespace

CameraMaps::CameraMaps() : technique_{make_technique("bounding_opacity_maps")} {
    technique_->param("split").assign(std::string{"hybrid"});  // a search reads back
}

void CameraMaps::add(FrameGraph& graph, const PictureInputs& inputs) {
    space_ = camera_space(inputs);
    update_light_view(view_, space_);
    cull(inputs);
    const FrameGraph::Scope scope{graph, "camera"};
    // Nothing is drawn into it: cleared once, it says that nothing opaque is before the camera.
    Texture& no_depth = graph.texture(
        "opaque_depth",
        {.format = Format::depth32f, .width = space_.width_px(), .height = space_.height_px()});
    graph.add({.name = "opaque_depth",
               .shader = {.vertex = "casters.vert.glsl",
                          .fragment = "bounds.frag.glsl",
                          .defines = light_defines(space_)},
               .draws = &nothing_,
               .view = &view_,
               .writes = {&no_depth},
               .state = {.depth = Depth::less, .clear_depth = 1.f}});
    const FrameGraph::Scope technique{graph, technique_->name()};
    look_up_ = technique_->build(
        graph, {view_, inputs.lists.blended, no_depth, false, false, space_, unused_});
}

// By the window of the maps, which is larger than the picture: what lies beside that may reach into
// texels that filters take at its edge.
void CameraMaps::cull(const PictureInputs& inputs) {
    if (!inputs.settings.culling.get()) return view_.see_all();
    view_.cull(inputs.lists.blended.shapes(), [this](const Box& points, double reach) {
        return is_out_of_map(space_, points, reach);
    });
}

void CameraMaps::add_look_up(Pass& pass) const {
    pass.shader.camera_technique = technique_->shader_path();
    pass.shader.camera_defines = look_up_.defines;
    pass.camera_reads = look_up_.reads;  // the view among them
}

}  // namespace opacity::render
