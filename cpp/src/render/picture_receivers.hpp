// Where the picture asks for T: at the first surface in the middle of each pixel.
#pragma once

#include "render/shading.hpp"

namespace opacity::render {

class ReceiverPass {
   public:
    // Declares the pass, which runs on request only. Returns the goal.
    const Resource& add(FrameGraph& graph, const PictureInputs& inputs, const Shading& shading);
    PictureReceivers read(Device& device) const;

   private:
    View frame_{"light"};  // the scene's own, in place of a light's
    Texture* receivers_ = nullptr;
};

}  // namespace opacity::render
