// Which primitives of a caster may leave fragments in which band of rows of the map, so that the
// thread of a band looks at no others. Found once, while neither the caster nor the light moves.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "opacity/scene/light_space.hpp"

namespace opacity {

struct LightCaster;

// Of the rows of each face, one face after the other.
inline constexpr int band_rows = 16;
inline std::size_t bands_a_face(const LightSpace& space) {
    return std::size_t(space.map_size_px + band_rows - 1) / band_rows;
}

// Segments, triangles or particles; 0 of a volume.
std::size_t primitive_count(const LightCaster& caster);

class CasterBands {
   public:
    CasterBands() = default;
    // `held`: by number, whether the map holds a primitive; empty: all of them.
    CasterBands(const LightCaster& caster, const LightSpace& space, std::span<const char> held);

    // By number, in their order. A volume is in every band, and not listed.
    std::span<const std::uint32_t> primitives(std::size_t band) const {
        return std::span{primitives_}.subspan(firsts_[band], firsts_[band + 1] - firsts_[band]);
    }

   private:
    std::vector<std::size_t> firsts_;
    std::vector<std::uint32_t> primitives_;
};

}  // namespace opacity
