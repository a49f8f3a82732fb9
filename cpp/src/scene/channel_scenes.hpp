// A scene whose shapes stop red, green and blue light by parts of their own is three scenes, each
// as light of one colour meets it: what a map, a ray or a picture takes of them is then a number
// again, and the three answers are those of three scenes without colour, bit for bit.
#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <vector>

#include "opacity/scene/scene.hpp"

namespace opacity {

class ChannelScenes {
   public:
    ChannelScenes() = default;
    explicit ChannelScenes(const Scene& scene) { update(scene); }

    // The scene itself where nothing is tinted. Shapes that have not changed stay as they were.
    void update(const Scene& scene);
    std::size_t count() const { return tinted_.empty() ? 1 : tinted_.size(); }
    bool is_tinted() const { return !tinted_.empty(); }
    const Scene& operator[](std::size_t channel) const {
        return tinted_.empty() ? *scene_ : tinted_[channel];
    }
    // What stands for a shape in a channel; for one that is not in the scene, itself.
    const Shape& shape(const Shape& original, std::size_t channel) const;

   private:
    using Channels = std::array<ShapePtr, channel_names.size()>;
    struct Parted {
        std::weak_ptr<Shape> original;
        Shape::Revisions revisions;
        Channels channels;
    };
    const Channels& parted(const ShapePtr& shape);

    const Scene* scene_ = nullptr;
    std::vector<Scene> tinted_;
    std::map<const Shape*, Parted> parted_;
};

// One answer a channel, side by side: red, green and blue of the first, then of the second.
std::vector<float> side_by_side(std::vector<std::vector<float>> channels);

}  // namespace opacity
