// The picture: what the camera sees of the shapes, lit through the maps of every light.
#pragma once

#include <deque>
#include <span>

#include "opacity/renderer.hpp"
#include "render/light_maps.hpp"

namespace opacity::render {

struct PictureInputs {
    const Scene& scene;
    const Camera& camera;
    const RenderSettings& settings;
    const float4& background;
    SceneLists& lists;
};

class Picture {
   public:
    // Declares the passes: one a light, and with several one that adds them up. Returns the goal.
    const Resource& add(FrameGraph& graph, const PictureInputs& inputs,
                        std::span<const std::unique_ptr<LightMaps>> lights);

    // Where the picture asks for T, in a frame of the scene's own; read only on request.
    const Resource& add_receivers(FrameGraph& graph, const PictureInputs& inputs);
    PictureReceivers receivers(Device& device) const;

   private:
    // Of one light: shading takes a light as it is, and ambient light once.
    struct Lamp {
        explicit Lamp(const std::string& scope);
        UniformSet color, ambient;
    };
    void update(const PictureInputs& inputs, std::span<const std::unique_ptr<LightMaps>> lights);
    void add_lighting(FrameGraph& graph, const PictureInputs& inputs, const LightMaps& maps,
                      std::size_t light, const Target& target);
    void add_composition(FrameGraph& graph, Texture& lit, Texture& image);

    View camera_{"camera"};
    std::deque<Lamp> lamps_;  // one a light, at least one
    View neutral_{"light"};   // stands for a light's where none is asked
    Texture* receivers_ = nullptr;
};

}  // namespace opacity::render
