// Where the rays of a footprint start: any number of them, one in each part of equal area.
#pragma once

#include <array>
#include <cstddef>

namespace opacity::rays {

// Offset of one sample from the middle, in -0.5 .. 0.5 of the footprint's side along either axis.
// The square is cut into rows, as many as whole numbers allow rows of cells about as wide as high;
// each row into equal cells, each of area 1 / samples; the sample lies anywhere in its own. It
// depends on nothing but the numbers given.
std::array<double, 2> footprint_offset(std::size_t point, int sample, int samples);

}  // namespace opacity::rays
