// The camera's own maps: how much of each sample it sees past the translucent shapes before it. A
// camera is a view as a light is: the maps are those of a technique, through one face.
#pragma once

#include <memory>

#include "map/light_casters.hpp"
#include "opacity/technique.hpp"
#include "render/shading.hpp"

namespace opacity::render {

class CameraMaps {
   public:
    CameraMaps();
    // Declares the passes that draw the blended shapes into the maps.
    void add(FrameGraph& graph, const PictureInputs& inputs);
    // Has a pass look them up: lib/camera_maps.glsl.
    void add_look_up(Pass& pass) const;

   private:
    void cull(const PictureInputs& inputs);

    std::unique_ptr<Technique> technique_;
    LightSpace space_;
    View view_{"camera/light"};
    DrawList nothing_{"opaque casters before the camera"};  // solids hide by depth already
    LightCasters unused_;
    LookUp look_up_;
};

}  // namespace opacity::render
