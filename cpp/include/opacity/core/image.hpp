// A picture: rows from the top, linear RGBA float32, premultiplied.
#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

namespace opacity {

struct Image {
    int width = 0, height = 0;
    std::vector<float> rgba;  // 4 * width * height

    const float* pixel(int x, int y) const { return &rgba[4 * (std::size_t(y) * width + x)]; }
};

}  // namespace opacity
