// Wavefront materials: what of them shadows need.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>

#include "opacity/core/math.hpp"

namespace opacity {

// A picture with the channel that is asked for: 'm' is its alpha, 'l' how light it is, 0 left open.
struct MaterialMap {
    std::string file;
    char channel = 0;
};

struct Material {
    std::optional<float3> color;
    float opacity = 1.f;
    MaterialMap color_map{}, alpha_map{};  // map_Kd, map_d; without a file where there is none
};

using Materials = std::map<std::string, Material, std::less<>>;

// Adds the file's materials, over those of the same name.
void read_mtl(const std::filesystem::path& path, Materials& materials);

}  // namespace opacity
