// Wavefront materials: what of them shadows need.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <string>

#include "opacity/core/math.hpp"

namespace opacity {

struct Material {
    float3 color{0.7f, 0.7f, 0.7f};  // a neutral grey
    float opacity = 1.f;
};

using Materials = std::map<std::string, Material, std::less<>>;

// Adds the file's materials, over those of the same name.
void read_mtl(const std::filesystem::path& path, Materials& materials);

}  // namespace opacity
