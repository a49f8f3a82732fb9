// What a picture is made of.
#pragma once

#include <memory>
#include <span>

#include "opacity/renderer.hpp"
#include "render/light_maps.hpp"

namespace opacity::render {

inline CameraView view_of(const Camera& camera, const RenderSettings& settings) {
    return {camera, double(settings.width.get()) / settings.height.get()};
}

struct PictureInputs {
    const Scene& scene;
    const Camera& camera;
    const RenderSettings& settings;
    const float4& background;
    SceneLists& lists;
    Compositing compositing;
    std::span<const std::unique_ptr<LightMaps>> lights;  // at least one
};

}  // namespace opacity::render
