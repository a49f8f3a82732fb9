#include "map/alpha.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace opacity {
namespace {

float mix(float a, float b, float t) {
    return a * (1.f - t) + b * t;
}

// The two texels of a row between which u lies, and how far it is from the first to the second.
struct Neighbours {
    int first, second;
    float part;

    Neighbours(float u, int size) {
        const float p = (u - std::floor(u)) * float(size) - 0.5f;
        const float below = std::floor(p);
        part = p - below;
        first = (int(below) + size) % size;
        second = (int(below) + 1) % size;
    }
};

float level_coverage(const TextureMap& level, const float2& uv) {
    const Neighbours x{uv[0], level.width}, y{uv[1], level.height};
    const auto row = [&](int j) {
        const float* values = &level.values[std::size_t(j) * level.width];
        return mix(values[x.first], values[x.second], x.part);
    };
    return mix(row(y.first), row(y.second), y.part);
}

}  // namespace

std::vector<TextureMap> coverage_levels(const Mesh& mesh) {
    TextureMap coverage = *mesh.alpha_map();
    if (mesh.alpha_mode() == AlphaMode::mask)
        for (float& value : coverage.values) value = value >= mesh.alpha_cutoff() ? 1.f : 0.f;
    return texture_levels(std::move(coverage));
}

float coverage_level(std::span<const TextureMap> levels, const float2& dx, const float2& dy) {
    const auto squared = [&](const float2& d) {
        const float x = d[0] * float(levels[0].width), y = d[1] * float(levels[0].height);
        return x * x + y * y;
    };
    const float largest = std::max({squared(dx), squared(dy), 1.f});
    return std::clamp(0.5f * std::log2(largest) - 0.5f, 0.f, float(levels.size() - 1));
}

float coverage_at(std::span<const TextureMap> levels, const float2& uv, float level) {
    const auto fine = std::size_t(level);
    const float coarser = level - float(fine);
    const float coverage = level_coverage(levels[fine], uv);
    if (!(coarser > 0.f)) return coverage;
    return mix(coverage, level_coverage(levels[fine + 1], uv), coarser);
}

}  // namespace opacity
