// The order in which a sweep asks its receivers: slab by slab, from the light on, each in all slabs
// that its taps may lie in. And which casters it draws for a plane: those near it, as what lies in
// front is stored in the map (Kim and Neumann 2001, section 4: volumes apart from each other).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "map/lookup.hpp"
#include "opacity/technique.hpp"

namespace opacity::render {

struct SlabLists {
    std::vector<std::uint32_t> receivers;  // by their index: slab i has those from firsts[i] on
    std::vector<std::size_t> firsts;       // and of the end

    std::size_t slabs() const { return firsts.size() - 1; }
    std::span<const std::uint32_t> of(std::size_t slab) const {
        return std::span{receivers}.subspan(firsts[slab], firsts[slab + 1] - firsts[slab]);
    }
};

// Slab i lies from planes[i] to planes[i + 1].
DepthSlab slab_of(std::span<const float> planes, std::size_t i);
// Where a shape's fragments may lie, in the light's depth.
DepthRange depths_of(const Shape& shape, const LightSpace& space);

// Those that change plane k of a sweep; it stays valid as long as `planes` and `space` do.
ShapeFilter near_plane(std::span<const float> planes, int k, const LightSpace& space);

SlabLists sorted_into_slabs(std::span<const Receiver> receivers, float width,
                            const MapLookUp& look_up, std::span<const float> planes);

}  // namespace opacity::render
