#include "render/frame.hpp"

#include <algorithm>

#include "render/first_surfaces.hpp"
#include "scene/texel_side.hpp"

namespace opacity::render {

void Frame::fit_lights(const FrameInputs& inputs, const Box& query, std::size_t asked) {
    const auto& lights = inputs.scene.lights();
    const std::size_t count = std::max<std::size_t>(lights.size(), 1);
    lights_.resize(std::min(lights_.size(), count));
    while (lights_.size() < count) {
        const std::string scope = lights_.empty() ? "" : "light" + std::to_string(lights_.size());
        lights_.push_back(std::make_unique<LightMaps>(scope));
    }
    const RenderSettings& settings = inputs.settings;
    const CameraView camera{inputs.camera, double(settings.width.get()) / settings.height.get()};
    for (std::size_t i = 0; i < count; ++i)
        lights_[i]->fit(inputs.scene, lights.empty() ? nullptr : lights[i].get(),
                        {inputs.technique, settings.map_size, settings.steady}, camera,
                        i == asked ? query : Box{});
}

Frame::Goals Frame::declare(const FrameInputs& inputs, const Box& query, std::size_t asked) {
    graph_.begin();  // first: the passes declared last refer to lights that may go
    // Without shaders there are no pictures, and no use for more than one pass of them.
    const Compositing compositing =
        device_.runs_shaders() ? compositing_of(inputs.settings.compositing) : Compositing::opaque;
    lists_.update_casters(inputs.scene);
    lists_.update_seen(inputs.scene, compositing, inputs.camera.eye());
    fit_lights(inputs, query, asked);
    device_.collect();
    for (const auto& light : lights_) light->add_passes(graph_, lists_);
    const PictureInputs picture{inputs.scene, inputs.camera, inputs.settings, inputs.background,
                                lists_,       compositing,   lights_};
    const Resource& image = picture_.add(graph_, picture);
    first_surfaces_ = add_first_surfaces(graph_, picture, picture_.shading());
    return {image, receivers_.add(graph_, picture, picture_.shading())};
}

void Frame::render(const FrameInputs& inputs, std::span<float> rgba) {
    const Goals goals = declare(inputs);
    graph_.run(goals.image);
    device_.read(goals.image, std::as_writable_bytes(rgba));
}

std::vector<float4> Frame::first_surfaces(const FrameInputs& inputs, std::size_t light) {
    declare(inputs);
    const Texture& surfaces = *first_surfaces_.at(light);
    graph_.run(surfaces);
    std::vector<float4> seen(std::size_t(surfaces.desc().width) * surfaces.desc().height);
    device_.read(surfaces, std::as_writable_bytes(std::span{seen}));
    return with_scene_indices(std::move(seen), lists_.surfaces, inputs.scene);
}

PictureReceivers Frame::receivers(const FrameInputs& inputs) {
    const Goals goals = declare(inputs);
    graph_.run(goals.receivers);
    return receivers_.read(device_);
}

std::vector<float> Frame::transmittance(const FrameInputs& inputs, const Query& query,
                                        std::size_t light) {
    declare(inputs, query.world_points.bounds(), light);
    LightMaps& maps = *lights_.at(light);
    maps.ask(query);
    graph_.run(maps.transmittance_goal());
    return maps.answers();
}

double4x4 Frame::light_from_world(std::size_t light) const {
    return light < lights_.size() ? lights_[light]->space().from_world : identity;
}

std::vector<double> Frame::texel_sides(const Positions& world_points, std::size_t light) const {
    std::vector<double> sides;
    for (std::size_t i = 0; light < lights_.size() && i < world_points.size(); ++i)
        sides.push_back(texel_side(lights_[light]->space(), world_points[i]));
    return sides;
}

}  // namespace opacity::render
