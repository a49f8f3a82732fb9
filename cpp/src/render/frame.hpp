// One frame as data: the passes of the render manager around those of the techniques; of a tinted
// scene once for each colour.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "render/frame_channel.hpp"
#include "scene/channel_scenes.hpp"

namespace opacity::render {

class Frame {
   public:
    explicit Frame(Device& device) : device_{device}, graph_{device} {}

    void render(const FrameInputs& inputs, std::span<float> rgba);
    // Of the scene's light of that index; of none, if it has none. Of a tinted scene three values a
    // point: red, green, blue.
    void transmittance(const FrameInputs& inputs, const Query& query, std::size_t light,
                       std::span<float> out);
    PictureReceivers receivers(const FrameInputs& inputs);
    // In the middle of each pixel: T of a light, the distance from the eye, and the shape's index
    // in the scene; -1, -1 where there is none. One picture a channel.
    std::vector<std::vector<float4>> first_surfaces(const FrameInputs& inputs, std::size_t light);
    FrameGraph& graph() { return graph_; }
    // As the last frame fitted it; identity for a light that it did not have.
    double4x4 light_from_world(std::size_t light) const;
    // World units, at each point; none for a light that the last frame did not have.
    std::vector<double> texel_sides(const Positions& world_points, std::size_t light) const;

   private:
    // `query` are points that `asked`, a light, will be asked about.
    void declare(const FrameInputs& inputs, const Box& query = {}, std::size_t asked = 0);
    // One goal a channel.
    FrameGraph::Goals goals(const std::function<const Resource&(FrameChannel&)>& of);
    const LightMaps* find_light(std::size_t index) const;

    Device& device_;
    ChannelScenes scenes_;
    std::vector<std::unique_ptr<FrameChannel>> channels_;  // one, or one a colour
    FrameGraph graph_;  // last: it frees its resources while the rest is alive
};

}  // namespace opacity::render
