// Boxes around what casts, as a hierarchy sorts them: a long slanting segment has several, since
// one box around all of it would be met by many rays that pass it by.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "rays/casters.hpp"

namespace opacity::rays {

// Boxes grow by this much, in the frame's units: more than all that float32 rounds, of rays in any
// direction.
inline constexpr double box_margin = 0x1p-19;

struct Piece {
    std::array<float, 3> min, max;
    std::uint32_t primitive;
};

std::vector<Piece> pieces_of(const Casters& casters);

}  // namespace opacity::rays
