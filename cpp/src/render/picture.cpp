#include "render/picture.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "render/lamp.hpp"
#include "scene/bias.hpp"

namespace opacity::render {
namespace {

using Lights = std::span<const std::unique_ptr<LightMaps>>;

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

// The scene about its middle, in radii of it.
double4x4 neutral_from_world(const Scene& scene) {
    const Box bounds = scene.bounds();
    if (bounds.empty()) return identity;
    const double scale = 1.0 / std::max(bounds.radius(), 1e-30);
    const double3 c = bounds.center();
    return {scale, 0, 0,     -scale * c[0], 0, scale, 0, -scale * c[1],
            0,     0, scale, -scale * c[2], 0, 0,     0, 1};
}

TextureDesc picture_desc(const RenderSettings& settings) {
    return {.format = Format::rgba32f,
            .width = settings.width.get(),
            .height = settings.height.get(),
            .oversampling = settings.antialiasing.get()};
}

// A layer of single samples for each light.
TextureDesc sample_layers(const RenderSettings& settings, std::size_t lights) {
    const int n = settings.antialiasing.get();
    return {.format = Format::rgba32f,
            .width = n * settings.width.get(),
            .height = n * settings.height.get(),
            .layers = int(lights)};
}

float4 premultiplied(const float4& b) {
    return {b[0] * b[3], b[1] * b[3], b[2] * b[3], b[3]};
}

const Light* light_of(const Scene& scene, std::size_t index) {
    return index < scene.lights().size() ? scene.lights()[index].get() : nullptr;
}

}  // namespace

Picture::Lamp::Lamp(const std::string& scope)
    : color{scope.empty() ? "light_color" : scope + "/light_color"}, ambient{"no ambient light"} {
    ambient.update({{"u_ambient", 0.f}});
}

void Picture::update(const PictureInputs& inputs, Lights lights) {
    const double aspect = double(inputs.settings.width.get()) / inputs.settings.height.get();
    const double4x4 view = inputs.camera.view_from_world();
    const std::vector<float> projection =
        clip_from_view(inputs.camera, aspect, near_distance(inputs.scene));
    camera_.update(
        view, {{"u_camera_clip_from_view", projection}, {"u_camera_rotation", rotation_of(view)}});
    while (lamps_.size() > lights.size()) lamps_.pop_back();
    for (std::size_t i = 0; i < lights.size(); ++i) {
        if (i == lamps_.size()) lamps_.emplace_back(lights[i]->scope());
        lamps_[i].color.update(lamp_uniforms(light_of(inputs.scene, i), view));
    }
}

const Resource& Picture::add(FrameGraph& graph, const PictureInputs& inputs, Lights lights) {
    update(inputs, lights);
    Texture& image = graph.texture("image", picture_desc(inputs.settings));
    if (lights.size() == 1) {
        add_lighting(graph, inputs, *lights[0], 0, &image);
        return image;
    }
    Texture& lit = graph.texture("lit", sample_layers(inputs.settings, lights.size()));
    for (std::size_t i = 0; i < lights.size(); ++i)
        add_lighting(graph, inputs, *lights[i], i, {&lit, int(i)});
    add_composition(graph, lit, image);
    return image;
}

void Picture::add_lighting(FrameGraph& graph, const PictureInputs& inputs, const LightMaps& maps,
                           std::size_t light, const Target& target) {
    std::optional<FrameGraph::Scope> scope;
    if (!maps.scope().empty()) scope.emplace(graph, maps.scope());
    TextureDesc desc = target.texture->desc();
    desc.format = Format::depth32f;
    desc.layers = 0;
    Texture& depth = graph.texture("camera_depth", desc);
    const ShadowLookUp& look_up = maps.look_up();
    const RenderSettings& settings = inputs.settings;
    const DrawList& visible = inputs.lists.visible;
    Reads reads = look_up.reads;
    Defines defines = look_up.defines;
    for (auto& define : lamp_defines(light_of(inputs.scene, light))) defines.push_back(define);
    if (look_up.own_correction) {
        reads.push_back(&visible.opacity);
        defines.emplace_back("OWN_CORRECTION", "1");
    }
    const Source& ambient =
        light == 0 ? static_cast<const Source&>(settings.ambient) : lamps_[light].ambient;
    reads.insert(reads.end(), {&visible.color, &lamps_[light].color, &ambient, &settings.specular,
                               &settings.shininess});
    graph.add({.name = "lighting",
               .shader = {.vertex = "lighting.vert.glsl",
                          .fragment = "lighting.frag.glsl",
                          .technique = look_up.shader,
                          .defines = std::move(defines)},
               .draws = &inputs.lists.visible,
               .view = &camera_,
               .reads = std::move(reads),
               .writes = {target, &depth},
               .state = {.depth = Depth::greater,
                         .clear_depth = 0.f,
                         .clear_color = light == 0 ? premultiplied(inputs.background) : float4{}}});
}

void Picture::add_composition(FrameGraph& graph, Texture& lit, Texture& image) {
    graph.add({.name = "composition",
               .shader = {.compute = "compose.comp.glsl"},
               .reads = {&lit},
               .stores = {&image},
               .execute = [&image](PassContext& context) {
                   context.dispatch(image.desc().width * image.desc().height);
               }});
}

const Resource& Picture::add_receivers(FrameGraph& graph, const PictureInputs& inputs) {
    neutral_.update(neutral_from_world(inputs.scene),
                    {{"u_light_least_bias", float(least_bias(inputs.scene))}});
    TextureDesc desc = picture_desc(inputs.settings);
    desc.oversampling = 1;
    receivers_ = &graph.texture("receivers", desc);
    desc.format = Format::depth32f;
    Texture& depth = graph.texture("receivers_depth", desc);
    graph.add(
        {.name = "receivers",
         .shader = {.vertex = "lighting.vert.glsl", .fragment = "receivers.frag.glsl"},
         .draws = &inputs.lists.visible,
         .view = &camera_,
         .reads = {&neutral_, &inputs.lists.visible.color},
         .writes = {receivers_, &depth},
         .state = {.depth = Depth::greater, .clear_depth = 0.f, .clear_color = {0, 0, 0, -2}}});
    return *receivers_;
}

PictureReceivers Picture::receivers(Device& device) const {
    PictureReceivers result{receivers_->desc().width, receivers_->desc().height, {}, {}};
    const std::size_t count = std::size_t(result.width) * result.height;
    std::vector<float> points(4 * count);
    device.read(*receivers_, std::as_writable_bytes(std::span{points}));
    const double4x4& m = neutral_.from_world();
    result.points_ws.reserve(3 * count);
    result.bias.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
        const float* p = &points[4 * i];
        const bool is_seen = p[3] > -1.5f;
        for (int axis = 0; axis < 3; ++axis)
            result.points_ws.push_back(is_seen ? (p[axis] - m[4 * axis + 3]) / m[0] : 0.0);
        result.bias.push_back(p[3]);
    }
    return result;
}

}  // namespace opacity::render
