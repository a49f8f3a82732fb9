// How much of a texel a surface with an alpha map covers: its coverage, averaged over the texel of
// the light's map, so that light passes a leaf in the distance as it passes one at hand. GLSL:
// lib/alpha.glsl.
#pragma once

#include <span>
#include <vector>

#include "map/texture_levels.hpp"
#include "opacity/core/math.hpp"
#include "opacity/scene/mesh.hpp"

namespace opacity {

// The alpha map of a mesh that has one as coverage, of a mask 0 or 1, and its means.
std::vector<TextureMap> coverage_levels(const Mesh& mesh);

// The level whose texels are as large as one of the light's map, between two levels in part; `dx`
// and `dy` are how much u and v change from one texel of the map to the next along its x and y.
float coverage_level(std::span<const TextureMap> levels, const float2& dx, const float2& dy);

// In 0 .. 1: linear between the texels of a level, and between two levels.
float coverage_at(std::span<const TextureMap> levels, const float2& uv, float level);

}  // namespace opacity
