#include "render/frame_channel.hpp"

#include <algorithm>

#include "render/first_surfaces.hpp"

namespace opacity::render {
void FrameChannel::fit_lights(const FrameInputs& inputs, const Box& query, std::size_t asked) {
    const auto& lights = inputs.scene.lights();
    const std::size_t count = std::max<std::size_t>(lights.size(), 1);
    lights_.resize(std::min(lights_.size(), count));
    while (lights_.size() < count) {
        const std::string scope = lights_.empty() ? "" : "light" + std::to_string(lights_.size());
        lights_.push_back(std::make_unique<LightMaps>(scope));
    }
    const RenderSettings& settings = inputs.settings;
    const CameraView camera = view_of(inputs.camera, settings);
    for (std::size_t i = 0; i < count; ++i)
        lights_[i]->fit(inputs.scene, lights.empty() ? nullptr : lights[i].get(),
                        {inputs.technique, settings.map_size, settings.map_detail, settings.steady,
                         settings.culling},
                        camera, i == asked ? query : Box{});
}

void FrameChannel::declare(FrameGraph& graph, Device& device, const FrameInputs& inputs,
                           const Box& query, std::size_t asked) {
    // Without shaders there are no pictures, and no use for more than one pass of them.
    const Compositing compositing = device.runs_shaders()
                                        ? compositing_of(inputs.settings.compositing, inputs.scene)
                                        : Compositing::opaque;
    lists_.update_casters(inputs.scene);
    lists_.update_seen(inputs.scene, compositing, view_of(inputs.camera, inputs.settings));
    fit_lights(inputs, query, asked);
    for (const auto& light : lights_) light->add_passes(graph, lists_);
    const PictureInputs picture{inputs.scene, inputs.camera, inputs.settings, inputs.background,
                                lists_,       compositing,   lights_};
    image_ = &picture_.add(graph, picture);
    first_surfaces_ = add_first_surfaces(graph, picture, picture_.shading());
    receivers_goal_ = &receivers_.add(graph, picture, picture_.shading());
}

}  // namespace opacity::render
