// The passes of a frame for one scene: all of it, or what one colour of light meets.
#pragma once

#include <memory>
#include <vector>

#include "opacity/graph/frame_graph.hpp"
#include "opacity/renderer.hpp"
#include "render/light_maps.hpp"
#include "render/picture.hpp"
#include "render/picture_receivers.hpp"
#include "render/scene_lists.hpp"

namespace opacity::render {

struct FrameInputs {
    const Scene& scene;
    const Camera& camera;
    const std::shared_ptr<Technique>& technique;
    const RenderSettings& settings;
    const float4& background;
};

class FrameChannel {
   public:
    // `query` are points that `asked`, a light, will be asked about.
    void declare(FrameGraph& graph, Device& device, const FrameInputs& inputs, const Box& query,
                 std::size_t asked);

    const Resource& image() const { return *image_; }
    const Resource& receivers() const { return *receivers_goal_; }
    const Texture& first_surfaces(std::size_t light) const { return *first_surfaces_.at(light); }
    LightMaps& light(std::size_t index) { return *lights_.at(index); }
    // Null: the last frame did not have it.
    const LightMaps* find_light(std::size_t index) const {
        return index < lights_.size() ? lights_[index].get() : nullptr;
    }
    const SceneLists& lists() const { return lists_; }
    PictureReceivers read_receivers(Device& device) const { return receivers_.read(device); }

   private:
    void fit_lights(const FrameInputs& inputs, const Box& query, std::size_t asked);

    SceneLists lists_;
    std::vector<std::unique_ptr<LightMaps>> lights_;  // at least one, to be lit by nothing
    Picture picture_;
    ReceiverPass receivers_;
    const Resource *image_ = nullptr, *receivers_goal_ = nullptr;
    std::vector<Texture*> first_surfaces_;  // one a light
};

}  // namespace opacity::render
