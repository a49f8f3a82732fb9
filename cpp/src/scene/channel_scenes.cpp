#include "scene/channel_scenes.hpp"

#include <utility>

namespace opacity {

void ChannelScenes::update(const Scene& scene) {
    scene_ = &scene;
    tinted_.clear();
    std::erase_if(parted_, [](const auto& entry) { return entry.second.original.expired(); });
    if (!scene.is_tinted()) return;
    tinted_.resize(channel_names.size());
    for (const ShapePtr& shape : scene.shapes()) {
        const Channels& channels = parted(shape);
        for (std::size_t c = 0; c < tinted_.size(); ++c) tinted_[c].add(channels[c]);
    }
    for (const LightPtr& light : scene.lights())
        for (Scene& channel : tinted_) channel.add(light);
}

const ChannelScenes::Channels& ChannelScenes::parted(const ShapePtr& shape) {
    Parted& parted = parted_[shape.get()];
    const auto [revisions, is_tinted] = [&] {
        const auto lock = shape->lock();
        return std::pair{shape->revisions(), shape->tint() != nullptr};
    }();
    if (parted.original.lock() == shape && parted.revisions == revisions) return parted.channels;
    parted.original = shape;
    parted.revisions = revisions;
    for (std::size_t c = 0; c < parted.channels.size(); ++c)
        parted.channels[c] = is_tinted ? shape->in_channel(c) : shape;
    return parted.channels;
}

const Shape& ChannelScenes::shape(const Shape& original, std::size_t channel) const {
    const auto found = parted_.find(&original);
    const bool is_here = !tinted_.empty() && found != parted_.end();
    return is_here ? *found->second.channels[channel] : original;
}

std::vector<float> side_by_side(std::vector<std::vector<float>> channels) {
    if (channels.size() == 1) return std::move(channels.front());
    std::vector<float> values;
    values.reserve(channels.size() * channels.front().size());
    for (std::size_t i = 0; i < channels.front().size(); ++i)
        for (const auto& channel : channels) values.push_back(channel[i]);
    return values;
}

}  // namespace opacity
