// One frame as data: the passes of the render manager around those of the techniques.
#pragma once

#include <memory>
#include <span>
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

class Frame {
   public:
    explicit Frame(Device& device) : device_{device}, graph_{device} {}

    void render(const FrameInputs& inputs, std::span<float> rgba);
    // Of the scene's light of that index; of none, if it has none.
    std::vector<float> transmittance(const FrameInputs& inputs, const Query& query,
                                     std::size_t light);
    PictureReceivers receivers(const FrameInputs& inputs);
    // In the middle of each pixel: T of a light, the distance from the eye, and the shape's index
    // in the scene; -1, -1 where there is none.
    std::vector<float4> first_surfaces(const FrameInputs& inputs, std::size_t light);
    FrameGraph& graph() { return graph_; }
    // As the last frame fitted it; identity for a light that it did not have.
    double4x4 light_from_world(std::size_t light) const;
    // World units, at each point; none for a light that the last frame did not have.
    std::vector<double> texel_sides(const Positions& world_points, std::size_t light) const;

   private:
    // What the goals of a frame are written to, besides each light's transmittance.
    struct Goals {
        const Resource &image, &receivers;
    };
    // `query` are points that `asked`, a light, will be asked about.
    Goals declare(const FrameInputs& inputs, const Box& query = {}, std::size_t asked = 0);
    void fit_lights(const FrameInputs& inputs, const Box& query, std::size_t asked);

    Device& device_;
    SceneLists lists_;
    std::vector<std::unique_ptr<LightMaps>> lights_;  // at least one, to be lit by nothing
    Picture picture_;
    ReceiverPass receivers_;
    std::vector<Texture*> first_surfaces_;  // of the last frame, one a light
    FrameGraph graph_;                      // last: it frees its resources while the rest is alive
};

}  // namespace opacity::render
