// A light as shading takes it, without its shadow: lib/lamp.glsl.
#pragma once

#include "opacity/graph/pass.hpp"
#include "opacity/scene/light.hpp"

namespace opacity::render {

// Null: no light at all.
Uniforms lamp_uniforms(const Light* light, const double4x4& view_from_world);
// Which kind it is, where that changes the shader.
Defines lamp_defines(const Light* light);

}  // namespace opacity::render
