#include "render/frame.hpp"

#include <algorithm>
#include <optional>

#include "render/first_surfaces.hpp"
#include "scene/texel_side.hpp"

namespace opacity::render {

void Frame::declare(const FrameInputs& inputs, const Box& query, std::size_t asked) {
    graph_.begin();  // first: the passes declared last refer to lights that may go
    scenes_.update(inputs.scene);
    channels_.resize(std::min(channels_.size(), scenes_.count()));
    while (channels_.size() < scenes_.count())
        channels_.push_back(std::make_unique<FrameChannel>());
    device_.collect();
    for (std::size_t c = 0; c < channels_.size(); ++c) {
        std::optional<FrameGraph::Scope> scope;
        if (scenes_.is_tinted()) scope.emplace(graph_, channel_names[c]);
        channels_[c]->declare(
            graph_, device_,
            {scenes_[c], inputs.camera, inputs.technique, inputs.settings, inputs.background},
            query, asked);
    }
}

FrameGraph::Goals Frame::goals(const std::function<const Resource&(FrameChannel&)>& of) {
    FrameGraph::Goals goals;
    for (const auto& channel : channels_) goals.push_back(&of(*channel));
    return goals;
}

void Frame::render(const FrameInputs& inputs, std::span<float> rgba) {
    declare(inputs);
    graph_.run(goals([](FrameChannel& channel) -> const Resource& { return channel.image(); }));
    device_.read(channels_[0]->image(), std::as_writable_bytes(rgba));
    if (!scenes_.is_tinted()) return;
    std::vector<float> of_channel(rgba.size());
    for (std::size_t c = 1; c < channels_.size(); ++c) {
        device_.read(channels_[c]->image(), std::as_writable_bytes(std::span{of_channel}));
        for (std::size_t i = 0; i < rgba.size(); i += 4) {
            rgba[i + c] = of_channel[i + c];
            rgba[i + 3] += of_channel[i + 3];
        }
    }
    for (std::size_t i = 3; i < rgba.size(); i += 4) rgba[i] /= float(channels_.size());
}

std::vector<std::vector<float4>> Frame::first_surfaces(const FrameInputs& inputs,
                                                       std::size_t light) {
    declare(inputs);
    graph_.run(goals(
        [&](FrameChannel& channel) -> const Resource& { return channel.first_surfaces(light); }));
    std::vector<std::vector<float4>> seen;
    for (std::size_t c = 0; c < channels_.size(); ++c) {
        const Texture& surfaces = channels_[c]->first_surfaces(light);
        std::vector<float4> values(std::size_t(surfaces.desc().width) * surfaces.desc().height);
        device_.read(surfaces, std::as_writable_bytes(std::span{values}));
        seen.push_back(
            with_scene_indices(std::move(values), channels_[c]->lists().surfaces, scenes_[c]));
    }
    return seen;
}

PictureReceivers Frame::receivers(const FrameInputs& inputs) {
    declare(inputs);
    graph_.run(channels_[0]->receivers());
    return channels_[0]->read_receivers(device_);
}

void Frame::transmittance(const FrameInputs& inputs, const Query& query, std::size_t light,
                          std::span<float> out) {
    declare(inputs, query.bounds, light);
    for (std::size_t c = 0; c < channels_.size(); ++c) {
        Query here = query;
        if (query.own) here.stand_on(scenes_.shape(*query.own, c), scenes_[c]);
        channels_[c]->light(light).ask(here);
    }
    graph_.run(goals([&](FrameChannel& channel) -> const Resource& {
        return channel.light(light).transmittance_goal();
    }));
    const std::size_t count = channels_.size();
    for (std::size_t c = 0; c < count; ++c) {
        const std::vector<float>& answers = channels_[c]->light(light).answers();
        for (std::size_t i = 0; i < answers.size(); ++i) out[i * count + c] = answers[i];
    }
}

const LightMaps* Frame::find_light(std::size_t index) const {
    return channels_.empty() ? nullptr : channels_[0]->find_light(index);
}

double4x4 Frame::light_from_world(std::size_t light) const {
    const LightMaps* maps = find_light(light);
    return maps ? maps->space().from_world : identity;
}

std::vector<double> Frame::texel_sides(const Positions& world_points, std::size_t light) const {
    std::vector<double> sides;
    const LightMaps* maps = find_light(light);
    for (std::size_t i = 0; maps && i < world_points.size(); ++i)
        sides.push_back(texel_side(maps->space(), world_points[i]));
    return sides;
}

}  // namespace opacity::render
