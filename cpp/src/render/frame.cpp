#include "render/frame.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "map/fragments.hpp"

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

}  // namespace

void Frame::update_sources(const FrameInputs& inputs, const Box& query) {
    static const DirectionalLight no_light{{0.0, 0.0, -1.0}, {0.f, 0.f, 0.f}, 0.f};
    const auto& lights = inputs.scene.lights();
    const DirectionalLight& light = lights.empty() ? no_light : require_directional(*lights.front());
    lists_.update(inputs.scene);
    space_ = fit_.fit(
        inputs.scene, light, [&](double side) { return map_size_px(inputs, side); }, query);
    light_.update(space_.from_world, {{"u_light_map_size_px", space_.map_size_px},
                                      {"u_light_depth_range", float(space_.depth_range)},
                                      {"u_light_texels_per_unit", float(space_.texels_per_unit)},
                                      {"u_light_least_bias", float(space_.least_bias)}});

    const double aspect = double(inputs.settings.width.get()) / inputs.settings.height.get();
    const double4x4 view = inputs.camera.view_from_world();
    const std::vector<float> projection =
        clip_from_view(inputs.camera, aspect, near_distance(inputs.scene));
    camera_.update(
        view, {{"u_camera_clip_from_view", projection}, {"u_camera_rotation", rotation_of(view)}});
    const auto floats = [](const auto& v, double factor) {
        return std::vector<float>{float(v[0] * factor), float(v[1] * factor), float(v[2] * factor)};
    };
    lamp_.update({{"u_to_light_ws", floats(light.direction(), -1.0)},
                  {"u_light_color", floats(light.color(), light.intensity())}});
}

int Frame::map_size_px(const FrameInputs& inputs, double side) {
    map_size_reason_.clear();
    if (!inputs.settings.map_size.is_auto()) return inputs.settings.map_size.get();
    const MapSize chosen =
        map_size_rule_.choose(inputs.scene, side, inputs.technique->filter_width.get());
    map_size_reason_ = std::to_string(chosen.size_px) + " texels: " + chosen.why;
    return chosen.size_px;
}

// Says in the report what was chosen before any pass could be declared, and why.
const Source& Frame::add_map_size() {
    auto& size_px = graph_.value("map_size", 0);
    graph_.add({.name = "map_size",
                .only_with = &lists_.translucent,
                .reads = {&light_, &technique_->filter_width},
                .values = {&size_px},
                .execute = [this, &size_px](PassContext& context) {
                    context.set(size_px, space_.map_size_px);
                    context.note(map_size_reason_);
                }});
    return size_px;
}

Frame::Goals Frame::declare(const FrameInputs& inputs, const Box& query) {
    technique_ = inputs.technique;
    update_sources(inputs, query);
    device_.collect();
    casters_.collect();
    graph_.begin();
    ShadowLookUp look_up = add_shadows(inputs);
    own_correction_ = look_up.own_correction;
    if (!map_size_reason_.empty()) look_up.reads.push_back(&add_map_size());
    look_up.reads.push_back(&light_);  // lighting places every vertex in the light's map
    Texture& image = add_lighting(inputs, look_up);
    return {image, query_.add(graph_, look_up, *technique_, space_),
            add_receivers(inputs.settings)};
}

ShadowLookUp Frame::add_shadows(const FrameInputs& inputs) {
    Texture& opaque_depth = add_opaque_depth("opaque_depth", false);
    Texture& opaque_surface = add_opaque_depth("opaque_surface", true);
    if (inputs.scene.lights().empty()) return {};
    const FrameGraph::Scope scope{graph_, technique_->name()};
    const bool has_opaque = !lists_.opaque.shapes().empty();
    const bool paper_deposit = technique_->deposit_rule.is("paper");
    return {technique_->build(graph_, {light_, lists_.translucent, opaque_depth, opaque_surface,
                                       has_opaque, paper_deposit, space_, casters_}),
            technique_->shader_path(), &opaque_depth, &opaque_surface};
}

Texture& Frame::add_opaque_depth(const std::string& name, bool at_surface) {
    Texture& map = graph_.texture(
        name,
        {.format = Format::depth32f, .width = space_.map_size_px, .height = space_.map_size_px});
    Defines defines;
    if (at_surface) defines.emplace_back("AT_SURFACE", "1");
    graph_.add({.name = name,
                .shader = {.vertex = "casters.vert.glsl",
                           .fragment = "bounds.frag.glsl",
                           .defines = std::move(defines)},
                .draws = &lists_.opaque,
                .view = &light_,
                .writes = {&map},
                .state = {.depth = Depth::less, .clear_depth = 1.f},
                .on_cpu = [this, &map, at_surface](PassContext& context) {
                    const std::span<float> depth = context.memory<float>(map);
                    const FragmentSource opaque{.casters = casters_,
                                                .shapes = lists_.opaque.shapes(),
                                                .space = space_,
                                                .opaque_depth = {},
                                                .optical_depth = false,
                                                .surface_margin = !at_surface};
                    for_each_fragment(opaque, [&](const Fragment& fragment) {
                        depth[fragment.texel] = std::min(depth[fragment.texel], fragment.depth);
                    });
                }});
    return map;
}

Texture& Frame::add_lighting(const FrameInputs& inputs, const ShadowLookUp& look_up) {
    const RenderSettings& settings = inputs.settings;
    TextureDesc picture{.format = Format::rgba32f,
                        .width = settings.width.get(),
                        .height = settings.height.get(),
                        .oversampling = settings.antialiasing.get()};
    Texture& image = graph_.texture("image", picture);
    picture.format = Format::depth32f;
    Texture& depth = graph_.texture("camera_depth", picture);
    Reads reads = look_up.reads;
    Defines defines = look_up.defines;
    if (look_up.own_correction) {
        reads.push_back(&lists_.visible.opacity);
        defines.emplace_back("OWN_CORRECTION", "1");
    }
    reads.insert(reads.end(), {&lists_.visible.color, &lamp_, &settings.ambient, &settings.specular,
                               &settings.shininess});
    const float4& b = inputs.background;
    graph_.add({.name = "lighting",
                .shader = {.vertex = "lighting.vert.glsl",
                           .fragment = "lighting.frag.glsl",
                           .technique = look_up.shader,
                           .defines = std::move(defines)},
                .draws = &lists_.visible,
                .view = &camera_,
                .reads = std::move(reads),
                .writes = {&image, &depth},
                .state = {.depth = Depth::greater,
                          .clear_depth = 0.f,
                          .clear_color = {b[0] * b[3], b[1] * b[3], b[2] * b[3], b[3]}}});
    return image;
}

// Where the picture asks for T: read only on request.
Texture& Frame::add_receivers(const RenderSettings& settings) {
    TextureDesc picture{
        .format = Format::rgba32f, .width = settings.width.get(), .height = settings.height.get()};
    Texture& receivers = graph_.texture("receivers", picture);
    picture.format = Format::depth32f;
    Texture& depth = graph_.texture("receivers_depth", picture);
    graph_.add(
        {.name = "receivers",
         .shader = {.vertex = "lighting.vert.glsl", .fragment = "receivers.frag.glsl"},
         .draws = &lists_.visible,
         .view = &camera_,
         .reads = {&light_, &lists_.visible.color},
         .writes = {&receivers, &depth},
         .state = {.depth = Depth::greater, .clear_depth = 0.f, .clear_color = {0, 0, 0, -2}}});
    return receivers;
}

void Frame::render(const FrameInputs& inputs, std::span<float> rgba) {
    const Goals goals = declare(inputs, Box{});
    graph_.run(goals.image);
    device_.read(goals.image, std::as_writable_bytes(rgba));
}

PictureReceivers Frame::receivers(const FrameInputs& inputs) {
    const Goals goals = declare(inputs, Box{});
    graph_.run(goals.receivers);
    PictureReceivers result{inputs.settings.width.get(), inputs.settings.height.get(), {}, {}};
    const std::size_t count = std::size_t(result.width) * result.height;
    std::vector<float> points_ls(4 * count);
    device_.read(goals.receivers, std::as_writable_bytes(std::span{points_ls}));
    const double4x4 to_world = world_from(space_);
    result.points_ws.reserve(3 * count);
    result.bias.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
        const float* p = &points_ls[4 * i];
        const bool is_seen = p[3] > -1.5f;
        const double3 point =
            is_seen ? transform_point(to_world, {p[0], p[1], p[2]}) : double3{0.0, 0.0, 0.0};
        result.points_ws.insert(result.points_ws.end(), point.begin(), point.end());
        result.bias.push_back(p[3]);
    }
    return result;
}

std::vector<float> Frame::transmittance(const FrameInputs& inputs, const Query& query) {
    const Goals goals = declare(inputs, query.world_points.bounds());
    query_.set(receivers_in(space_, query, own_correction_), query.width);
    graph_.run(goals.transmittance);
    return query_.answers();
}

}  // namespace opacity::render
