// One frame as data: the passes of the render manager around those of the technique.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "map/light_casters.hpp"
#include "opacity/graph/frame_graph.hpp"
#include "opacity/renderer.hpp"
#include "render/scene_lists.hpp"
#include "render/shadow_query.hpp"
#include "scene/light_fit.hpp"
#include "scene/map_size.hpp"

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
    std::vector<float> transmittance(const FrameInputs& inputs, const Query& query);
    PictureReceivers receivers(const FrameInputs& inputs);
    FrameGraph& graph() { return graph_; }
    const double4x4& light_from_world() const { return space_.from_world; }

   private:
    // What the goals of a frame are written to.
    struct Goals {
        const Resource &image, &transmittance, &receivers;
    };
    Goals declare(const FrameInputs& inputs, const Box& query);
    void update_sources(const FrameInputs& inputs, const Box& query);
    int map_size_px(const FrameInputs& inputs, double side);
    const Source& add_map_size();
    // `at_surface`: where casters are; else moved away from the light (lib/surface.glsl).
    Texture& add_opaque_depth(const std::string& name, bool at_surface);
    ShadowLookUp add_shadows(const FrameInputs& inputs);
    Texture& add_lighting(const FrameInputs& inputs, const ShadowLookUp& look_up);
    Texture& add_receivers(const RenderSettings& settings);

    Device& device_;
    // The passes declared last refer to its parameters.
    std::shared_ptr<Technique> technique_;
    SceneLists lists_;
    LightFit fit_;
    View light_{"light"}, camera_{"camera"};
    UniformSet lamp_{"light_color"};
    LightSpace space_;
    MapSizeRule map_size_rule_;
    std::string map_size_reason_;  // empty: the caller chose
    LightCasters casters_;
    bool own_correction_ = false;
    ShadowQuery query_;
    FrameGraph graph_;  // last: it frees its resources while the rest is alive
};

}  // namespace opacity::render
