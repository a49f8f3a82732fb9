// Level of detail of strands in a light's maps: fewer of them, each as many times as wide.
#pragma once

#include <cstddef>
#include <vector>

#include "opacity/scene/shape.hpp"
#include "opacity/scene/strands.hpp"

namespace opacity {

// In which order strands go where a map holds fewer of them. Neighbours along a curve through the
// box (scene/space_curve.hpp) get numbers of van der Corput's sequence, so that those below any
// number are spread evenly among all, and that a lower number leaves out more and adds none.
struct StrandRanks {
    std::vector<double> of_strands;  // in [0, 1); one is 0
    std::vector<double> sorted;

    // Where a part `detail` of them, in (0, 1], is held: those whose rank is below it.
    bool is_kept(std::size_t strand, double detail) const { return of_strands[strand] < detail; }
    std::size_t kept(double detail) const;
    // How many strands each of these stands for, and how many times as wide it is.
    double widening(double detail) const;
};

// With the lock held.
StrandRanks ranks_of(const Strands& strands);

// The factor of widths in a map that holds this part of the strands; 1 of other shapes. With the
// lock held.
double widening_of(const Shape& shape, double detail);
// How far its casters there reach beyond its points, in world units: widths scale evenly, whatever
// the transform does to the points.
double caster_reach(const Shape& shape, double detail);

// The strand of each segment.
std::vector<std::size_t> strand_numbers(const Strands& strands);

}  // namespace opacity
