// A light space as shaders see it (lib/light.glsl).
#pragma once

#include "opacity/graph/view.hpp"
#include "opacity/scene/light_space.hpp"

namespace opacity::render {

void update_light_view(View& view, const LightSpace& space);

}  // namespace opacity::render
