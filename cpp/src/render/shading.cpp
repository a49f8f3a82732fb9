#include "render/shading.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "render/lamp.hpp"

namespace opacity::render {
namespace {

// Reversed and without a far plane: depth is near / distance, which float32 resolves over any
// range. Rows go down, so that the first row read back is the top of the picture.
std::vector<float> clip_from_view(const Camera& camera, double aspect, double near) {
    const double focal = 1.0 / std::tan(camera.fov_deg() * std::numbers::pi / 360.0);
    std::vector<float> columns(16, 0.f);
    columns[0] = float(focal / aspect);
    columns[5] = float(-focal);
    columns[11] = -1.f;
    columns[14] = float(near);
    return columns;
}

// Depth is as precise for a near plane this close, and what a scene of this size holds is all
// behind it.
double near_distance(const Scene& scene) {
    return 1e-6 * std::max(scene.bounds().radius(), 1e-20);
}

// The rotation of a rigid matrix, by columns.
std::vector<float> rotation_of(const double4x4& m) {
    return {float(m[0]), float(m[4]), float(m[8]), float(m[1]), float(m[5]),
            float(m[9]), float(m[2]), float(m[6]), float(m[10])};
}

const Light* light_of(const Scene& scene, std::size_t index) {
    return index < scene.lights().size() ? scene.lights()[index].get() : nullptr;
}

}  // namespace

Shading::Lamp::Lamp(const std::string& scope)
    : color{scope.empty() ? "light_color" : scope + "/light_color"}, ambient{"no ambient light"} {
    ambient.update({{"u_ambient", 0.f}});
}

Shading::Shading() {
    camera_.look_from_origin();
}

void Shading::update(const PictureInputs& inputs) {
    const double aspect = view_of(inputs.camera, inputs.settings).aspect;
    const double4x4 view = inputs.camera.view_from_world();
    const std::vector<float> projection =
        clip_from_view(inputs.camera, aspect, near_distance(inputs.scene));
    camera_.update(
        view, {{"u_camera_clip_from_view", projection}, {"u_camera_rotation", rotation_of(view)}});
    while (lamps_.size() > inputs.lights.size()) lamps_.pop_back();
    for (std::size_t i = 0; i < inputs.lights.size(); ++i) {
        if (i == lamps_.size()) lamps_.emplace_back(inputs.lights[i]->scope());
        lamps_[i].color.update(lamp_uniforms(light_of(inputs.scene, i), view));
    }
}

void Shading::cull(const PictureInputs& inputs) {
    if (!inputs.settings.culling.get()) return camera_.see_all();
    const SceneLists& lists = inputs.lists;
    const CameraView view = view_of(inputs.camera, inputs.settings);
    for (const DrawList* list : {&lists.surfaces, &lists.solid, &lists.parted, &lists.blended})
        camera_.cull(list->shapes(), [&](const Box& world, double reach) {
            return is_out_of_view(view, world.padded(reach));
        });
}

void Shading::add(FrameGraph& graph, const PictureInputs& inputs) {
    update(inputs);
    strand_shadows_.begin_frame();
    if (!graph.runs_shaders()) return;  // no pictures either
    cull(inputs);
    SceneLists& lists = inputs.lists;
    for (std::size_t light = 0; light < inputs.lights.size(); ++light) {
        const LightScope scope{graph, inputs, light};
        const std::pair<const char*, DrawList*> seen[]{{"solid", &lists.solid},
                                                       {"parted", &lists.parted},
                                                       {"blended", &lists.blended},
                                                       {"surfaces", &lists.surfaces}};
        for (const auto& [name, list] : seen)
            strand_shadows_.add(graph, inputs, name, light, *list);
    }
}

Pass Shading::pass(const std::string& name, const PictureInputs& inputs, std::size_t light,
                   DrawList& shapes, bool opacity, Defines defines) const {
    const ShadowLookUp& look_up = inputs.lights[light]->look_up();
    const RenderSettings& settings = inputs.settings;
    Reads reads = look_up.reads;
    const auto add = [&](const Defines& more) {
        defines.insert(defines.end(), more.begin(), more.end());
    };
    add(look_up.defines);
    add(lamp_defines(light_of(inputs.scene, light)));
    if (look_up.own_correction) add({{"OWN_CORRECTION", "1"}});
    if (opacity) add({{"TRANSLUCENT", "1"}});
    if (opacity || look_up.own_correction) reads.push_back(&shapes.opacity);
    const Source& ambient =
        light == 0 ? static_cast<const Source&>(settings.ambient) : lamps_[light].ambient;
    reads.insert(reads.end(), {&shapes.color, &lamps_[light].color, &ambient, &settings.specular,
                               &settings.shininess, &settings.wrap, &settings.backlight,
                               &settings.phase, &settings.shadow_intensity});
    Pass pass{.name = name,
              .shader = {.vertex = "lighting.vert.glsl",
                         .fragment = "lighting.frag.glsl",
                         .technique = look_up.shader,
                         .defines = std::move(defines)},
              .draws = &shapes,
              .view = &camera_,
              .reads = std::move(reads)};
    strand_shadows_.add_look_up(pass, light, shapes);
    if (const std::size_t hidden = inputs.lists.out_of_view; hidden > 0)
        pass.execute = [hidden, all = inputs.scene.shapes().size()](PassContext& context) {
            context.draw();
            context.note(std::to_string(hidden) + " of " + std::to_string(all) +
                         " shapes out of view");
        };
    return pass;
}

Pass Shading::unlit_pass(const std::string& name, const std::string& fragment, DrawList& shapes,
                         Defines defines) const {
    return {.name = name,
            .shader = {.vertex = "lighting.vert.glsl",
                       .fragment = fragment,
                       .technique = "techniques/unshadowed.glsl",
                       .defines = std::move(defines)},
            .draws = &shapes,
            .view = &camera_,
            .reads = {&shapes.color}};
}

LightScope::LightScope(FrameGraph& graph, const PictureInputs& inputs, std::size_t light) {
    const std::string& name = inputs.lights[light]->scope();
    if (!name.empty()) scope_.emplace(graph, name);
}

}  // namespace opacity::render
