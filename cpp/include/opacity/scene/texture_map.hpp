// An image on a surface.
#pragma once

#include <memory>
#include <vector>

namespace opacity {

// Rows from v = 0 on, which is the top of the picture; it repeats beyond 0 .. 1.
struct TextureMap {
    int width = 0, height = 0, channels = 0;
    std::vector<float> values;  // channels * width * height, those of a texel side by side
};

using TextureMapPtr = std::shared_ptr<const TextureMap>;

// ParameterError named `name` unless it has so many channels, texels, and values in 0 .. most.
void check_texture_map(const char* name, const TextureMap& map, int channels, double most);

}  // namespace opacity
