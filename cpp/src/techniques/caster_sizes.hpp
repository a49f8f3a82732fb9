// How large the casters of a light are in its map, and how much light they take: what a scatter
// goes by.
#pragma once

#include <limits>
#include <vector>

#include "opacity/graph/draw_list.hpp"
#include "opacity/scene/light_space.hpp"

namespace opacity::techniques {

// World units: no segment of the shape is longer and none wider, no particle larger.
struct CasterSize {
    double length = std::numeric_limits<double>::infinity();
    double width = std::numeric_limits<double>::infinity();
    bool operator==(const CasterSize&) const = default;
};

// Of each shape in the list; of surfaces and volumes, which cover any number of texels, infinite.
std::vector<CasterSize> caster_sizes(const DrawList& casters);

// How many texels one of the shape's casters covers at most; infinite where the light is close to
// it.
double most_texels(const CasterSize& size, const Shape& shape, const LightSpace& space);

// Segments of a part of the strands, and particles, which no rasteriser need draw.
std::size_t small_caster_count(const DrawList& casters, double strand_detail);

// More optical depth than a texel can hold of these casters; infinite with volumes.
double most_optical_depth(const DrawList& casters);

}  // namespace opacity::techniques
