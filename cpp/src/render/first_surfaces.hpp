// What lies in the middle of each pixel: the first strand or surface, translucent ones too. A
// medium has no surface.
#pragma once

#include <vector>

#include "render/shading.hpp"

namespace opacity::render {

// Declares a pass a light, which runs on request only: T, distance from the eye, index in the list.
std::vector<Texture*> add_first_surfaces(FrameGraph& graph, const PictureInputs& inputs,
                                         const Shading& shading);

// The same with the index that each shape has in the scene.
std::vector<float4> with_scene_indices(std::vector<float4> surfaces, const DrawList& list,
                                       const Scene& scene);

}  // namespace opacity::render
