// Passes in which the camera sees shapes lit: each by one light, through that light's maps.
#pragma once

#include <deque>
#include <memory>
#include <optional>

#include "render/strand_shadows.hpp"

namespace opacity::render {

class Shading {
   public:
    Shading();
    // The camera and the lights as they are now, and the passes that those below read.
    void add(FrameGraph& graph, const PictureInputs& inputs);
    const View& camera() const { return camera_; }

    // Draws the shapes of a list by one light; where its samples go is the caller's to add. With
    // `opacity` shapes are as translucent as they are.
    Pass pass(const std::string& name, const PictureInputs& inputs, std::size_t light,
              DrawList& shapes, bool opacity, Defines defines = {}) const;
    // The same shapes, without light.
    Pass unlit_pass(const std::string& name, const std::string& fragment, DrawList& shapes,
                    Defines defines = {}) const;

   private:
    // Of one light: ambient light counts once.
    struct Lamp {
        explicit Lamp(const std::string& scope);
        UniformSet color, ambient;
    };
    void update(const PictureInputs& inputs);
    void cull(const PictureInputs& inputs);

    View camera_{"camera"};
    std::deque<Lamp> lamps_;  // one a light
    StrandShadows strand_shadows_;
};

// Scopes the names of what belongs to one of several lights.
class LightScope {
   public:
    LightScope(FrameGraph& graph, const PictureInputs& inputs, std::size_t light);

   private:
    std::optional<FrameGraph::Scope> scope_;
};

}  // namespace opacity::render
