// One frame as data: the passes of the render manager around those of the technique.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "opacity/graph/frame_graph.hpp"
#include "opacity/renderer.hpp"
#include "render/gl_device.hpp"
#include "render/scene_lists.hpp"
#include "scene/light_fit.hpp"

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
    explicit Frame(GlDevice& device) : device_{device}, graph_{device} {}

    void render(const FrameInputs& inputs, std::span<float> rgba);
    // A receiver of this strand width, in world units; 0 for a surface.
    std::vector<float> transmittance(const FrameInputs& inputs, const Positions& world_points,
                                     double receiver_width);
    PictureReceivers receivers(const FrameInputs& inputs);
    FrameGraph& graph() { return graph_; }
    const double4x4& light_from_world() const { return light_.from_world(); }

   private:
    // What the goals of a frame are written to.
    struct Goals {
        const Resource &image, &transmittance, &receivers;
    };
    Goals declare(const FrameInputs& inputs, const Box& query);
    void update_sources(const FrameInputs& inputs, const Box& query);
    Texture& add_opaque_depth(int map_size_px);
    // `look_up_shader` defines shadow_transmittance, and takes what `lookup` feeds.
    Texture& add_lighting(const FrameInputs& inputs, const Reads& lookup,
                          const std::string& look_up_shader);
    Texture& add_receivers(const RenderSettings& settings);
    // Points from `first` on, as many as fit one storage buffer.
    void ask(PassContext& context, Buffer& points, Buffer& result, std::size_t first);
    Buffer& add_transmittance(const Reads& lookup, const std::string& look_up_shader);

    GlDevice& device_;
    // The passes declared last refer to its parameters.
    std::shared_ptr<Technique> technique_;
    SceneLists lists_;
    LightFit fit_;
    View light_{"light"}, camera_{"camera"};
    UniformSet lamp_{"light_color"};
    UniformSet query_{"query_points"};
    std::vector<float> query_points_ls_;  // four floats a point
    float query_width_ = 0.f;
    std::vector<float> transmittance_;
    FrameGraph graph_;  // last: it frees its resources while the rest is alive
};

}  // namespace opacity::render
