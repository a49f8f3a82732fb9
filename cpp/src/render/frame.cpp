#include "render/frame.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace opacity::render {
namespace {

// Questions are asked in parts: a storage buffer may end at 128 MiB.
constexpr std::size_t most_points = std::size_t{1} << 22;

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

// Of what turns, moves and scales along its own axes: the rows of such a matrix are orthogonal.
double4x4 inverse_of(const double4x4& m) {
    double4x4 result{};
    for (int row = 0; row < 3; ++row) {
        double squared = 0.0;
        for (int i = 0; i < 3; ++i) squared += m[4 * row + i] * m[4 * row + i];
        for (int i = 0; i < 3; ++i) {
            result[4 * i + row] = m[4 * row + i] / squared;
            result[4 * i + 3] -= m[4 * row + 3] * m[4 * row + i] / squared;
        }
    }
    result[15] = 1.0;
    return result;
}

}  // namespace

void Frame::update_sources(const FrameInputs& inputs, const Box& query) {
    static const DirectionalLight no_light{{0.0, 0.0, -1.0}, {0.f, 0.f, 0.f}, 0.f};
    const auto& lights = inputs.scene.lights();
    const DirectionalLight& light = lights.empty() ? no_light : *lights.front();
    lists_.update(inputs.scene);
    const LightSpace space = fit_.fit(inputs.scene, light, inputs.settings.map_size.get(), query);
    light_.update(space.from_world, {{"u_light_map_size_px", space.map_size_px},
                                     {"u_light_depth_range", float(space.depth_range)},
                                     {"u_light_texels_per_unit", float(space.texels_per_unit)},
                                     {"u_light_least_bias", float(space.least_bias)}});

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

Frame::Goals Frame::declare(const FrameInputs& inputs, const Box& query) {
    technique_ = inputs.technique;
    update_sources(inputs, query);
    device_.collect();
    graph_.begin();
    const int map_size_px = inputs.settings.map_size.get();
    Texture& opaque_depth = add_opaque_depth(map_size_px);
    Reads lookup;
    std::string look_up_shader = "techniques/unshadowed.glsl";  // without a light
    if (!inputs.scene.lights().empty()) {
        look_up_shader = technique_->shader_path();
        const FrameGraph::Scope scope{graph_, technique_->name()};
        lookup = technique_->build(graph_, {light_, lists_.translucent, opaque_depth,
                                            !lists_.opaque.shapes().empty(), map_size_px});
    }
    lookup.push_back(&light_);  // lighting places every vertex in the light's map
    Texture& image = add_lighting(inputs, lookup, look_up_shader);
    return {image, add_transmittance(lookup, look_up_shader), add_receivers(inputs.settings)};
}

Texture& Frame::add_opaque_depth(int map_size_px) {
    Texture& opaque_depth = graph_.texture(
        "opaque_depth", {.format = Format::depth32f, .width = map_size_px, .height = map_size_px});
    graph_.add({.name = "opaque_depth",
                .shader = {.vertex = "casters.vert.glsl", .fragment = "bounds.frag.glsl"},
                .draws = &lists_.opaque,
                .view = &light_,
                .writes = {&opaque_depth},
                .state = {.depth = Depth::less, .clear_depth = 1.f}});
    return opaque_depth;
}

Texture& Frame::add_lighting(const FrameInputs& inputs, const Reads& lookup,
                             const std::string& look_up_shader) {
    const RenderSettings& settings = inputs.settings;
    TextureDesc picture{.format = Format::rgba32f,
                        .width = settings.width.get(),
                        .height = settings.height.get(),
                        .oversampling = settings.antialiasing.get()};
    Texture& image = graph_.texture("image", picture);
    picture.format = Format::depth32f;
    Texture& depth = graph_.texture("camera_depth", picture);
    Reads reads = lookup;
    reads.insert(reads.end(), {&lists_.visible.color, &lamp_, &settings.ambient, &settings.specular,
                               &settings.shininess});
    const float4& b = inputs.background;
    graph_.add({.name = "lighting",
                .shader = {.vertex = "lighting.vert.glsl",
                           .fragment = "lighting.frag.glsl",
                           .technique = look_up_shader},
                .draws = &lists_.visible,
                .view = &camera_,
                .reads = std::move(reads),
                .writes = {&image, &depth},
                .state = {.depth = Depth::greater,
                          .clear_depth = 0.f,
                          .clear_color = {b[0] * b[3], b[1] * b[3], b[2] * b[3], b[3]}}});
    return image;
}

Buffer& Frame::add_transmittance(const Reads& lookup, const std::string& look_up_shader) {
    Buffer& points = graph_.buffer("points_ls");
    Buffer& result = graph_.buffer("transmittance");
    Reads reads = lookup;
    reads.push_back(&query_);
    graph_.add({.name = "transmittance",
                .shader = {.compute = "transmittance.comp.glsl", .technique = look_up_shader},
                .reads = std::move(reads),
                .stores = {&points, &result},
                .execute = [this, &points, &result](PassContext& context) {
                    transmittance_.clear();
                    for (std::size_t first = 0; first < query_points_ls_.size();
                         first += 4 * most_points)
                        ask(context, points, result, first);
                }});
    return result;
}

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

void Frame::ask(PassContext& context, Buffer& points, Buffer& result, std::size_t first) {
    const std::span<const float> part = std::span{query_points_ls_}.subspan(
        first, std::min(4 * most_points, query_points_ls_.size() - first));
    const int count = int(part.size() / 4);
    context.resize(points, part.size_bytes());
    context.resize(result, count * sizeof(float));
    context.write(points, std::as_bytes(part));
    context.dispatch(count, {{"u_point_count", count}, {"u_receiver_width", query_width_}});
    const std::vector<float> answers = context.read<float>(result);
    transmittance_.insert(transmittance_.end(), answers.begin(), answers.end());
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
    const double4x4 to_world = inverse_of(light_.from_world());
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

std::vector<float> Frame::transmittance(const FrameInputs& inputs, const Positions& world_points,
                                        double receiver_width) {
    const Goals goals = declare(inputs, world_points.bounds());
    query_points_ls_.resize(4 * world_points.size());
    for (std::size_t i = 0; i < world_points.size(); ++i) {
        const double3 p = transform_point(light_.from_world(), world_points[i]);
        for (int axis = 0; axis < 3; ++axis) query_points_ls_[4 * i + axis] = float(p[axis]);
        query_points_ls_[4 * i + 3] = 0.f;
    }
    query_width_ = float(receiver_width);
    query_.touch();
    graph_.run(goals.transmittance);
    return transmittance_;
}

}  // namespace opacity::render
