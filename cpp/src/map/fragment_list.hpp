// What changes the optical depth in front, for every texel, one texel's entries after the other.
// GLSL: lib/fragment_list.glsl.
#pragma once

#include <compare>
#include <cstdint>

namespace opacity {

constexpr int list_row = 4096;  // entries of a row of the texture that holds them

// At a depth: a point adds optical depth, an interval a density where it begins, and takes it away
// where it ends. Later the sums of these over all entries so far.
struct ListEntry {
    float depth, optical_depth, density;
    std::uint32_t texel;  // which nobody needs here
    auto operator<=>(const ListEntry&) const = default;

    float optical_depth_at(float behind) const {
        return optical_depth + density * (behind - depth);
    }
};
static_assert(sizeof(ListEntry) == 16);

}  // namespace opacity
