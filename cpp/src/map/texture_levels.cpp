#include "map/texture_levels.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace opacity {
namespace {

// A line of `from` elements, `stride` numbers apart, becomes one of `to` elements.
struct Axis {
    int from, to;
    std::size_t stride;
};

// The mean of the elements from i * from / to to (i + 1) * from / to, cut ones by their part.
float mean_at(const float* line, const Axis& axis, int i) {
    const double begin = double(i) * axis.from / axis.to, end = double(i + 1) * axis.from / axis.to;
    double sum = 0.0;
    for (int k = int(begin); k < axis.from && k < end; ++k)
        sum += (std::min(end, k + 1.0) - std::max(begin, double(k))) *
               double(line[std::size_t(k) * axis.stride]);
    return float(sum / (end - begin));
}

TextureMap halved_along_x(const TextureMap& image) {
    TextureMap result{std::max(1, image.width / 2), image.height, image.channels, {}};
    const Axis axis{image.width, result.width, std::size_t(image.channels)};
    result.values.reserve(std::size_t(result.width) * result.height * result.channels);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < result.width; ++x)
            for (int c = 0; c < image.channels; ++c) {
                const std::size_t row = std::size_t(y) * image.width * image.channels;
                result.values.push_back(mean_at(&image.values[row + c], axis, x));
            }
    return result;
}

TextureMap halved_along_y(const TextureMap& image) {
    TextureMap result{image.width, std::max(1, image.height / 2), image.channels, {}};
    const std::size_t row = std::size_t(image.width) * image.channels;
    const Axis axis{image.height, result.height, row};
    result.values.reserve(row * result.height);
    for (int y = 0; y < result.height; ++y)
        for (std::size_t i = 0; i < row; ++i)
            result.values.push_back(mean_at(&image.values[i], axis, y));
    return result;
}

}  // namespace

std::vector<TextureMap> texture_levels(TextureMap image) {
    std::vector<TextureMap> levels{std::move(image)};
    while (levels.back().width > 1 || levels.back().height > 1)
        levels.push_back(halved_along_y(halved_along_x(levels.back())));
    return levels;
}

}  // namespace opacity
