// An image at ever fewer texels, each the mean of those that it stands for.
#pragma once

#include <vector>

#include "opacity/scene/texture_map.hpp"

namespace opacity {

// The image itself, then half of its width and height each time, rounded down, to a single texel:
// the levels that OpenGL expects. Means are by area, so that the mean of every level is that of the
// image whatever its size.
std::vector<TextureMap> texture_levels(TextureMap image);

}  // namespace opacity
