// Grass around the origin on the ground z = 0, in centimetres.
#pragma once

#include <cstddef>
#include <memory>

#include "opacity/scene/strands.hpp"

namespace opacity::demo {

// The patch grows with the number of segments: grass of one kind is as dense at any number.
struct Meadow {
    double blades_per_square_meter;
    double height;  // of a usual blade
    double droop;   // 0: blades stand, 1: their tips hang
    double straw;   // the part of blades that is dry
    double width = 0.42;
};

std::shared_ptr<Strands> grass(const Meadow& meadow, std::size_t segments, unsigned seed);
// Of the patch that so many segments cover, from its middle to its edge.
double meadow_radius(const Meadow& meadow, std::size_t segments);

}  // namespace opacity::demo
