#include "opacity/scene/texture_map.hpp"

#include <string>

#include "opacity/core/error.hpp"
#include "scene/check.hpp"

namespace opacity {

void check_texture_map(const char* name, const TextureMap& map, int channels, double most) {
    constexpr int most_px = 16384;
    const auto is_side = [](int px) { return px >= 1 && px <= most_px; };
    const std::string size = std::to_string(map.width) + " x " + std::to_string(map.height);
    if (!is_side(map.width) || !is_side(map.height))
        throw ParameterError(std::string{name} + " has " + size + " texels",
                             "pass 1 .. " + std::to_string(most_px) + " along either side");
    const std::size_t count = std::size_t(map.width) * map.height * channels;
    if (map.channels != channels || map.values.size() != count)
        throw ParameterError(std::string{name} + " holds " + std::to_string(map.values.size()) +
                                 " values for " + size + " texels",
                             "pass " + std::to_string(channels) + " a texel");
    check_values(name, map.values, {0.0, most, most == 1.0 ? "in 0..1" : "in 0..1e9"},
                 std::size_t(channels));
}

}  // namespace opacity
