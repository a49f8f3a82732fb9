// What K layers cost: the error of T that a look-up in them makes, estimated from fine profiles.
#pragma once

#include <cstddef>
#include <vector>

#include "opacity/core/optical_depth_profiles.hpp"

namespace opacity {

// How T is looked up in layers.
struct LayerLookUp {
    bool own_correction = false;  // leaves the receiver's own ramp out
    bool few_casters = false;     // of layers with moments: two share a layer's optical depth
};

// How well the layers rebuild the fine profiles of the same texels for receivers that lie where
// casters are: the RMSE of T that the look-up finds at the middle of each fine cell, and on the
// last caster, against T in front of it; each fragment counts once, and a medium by its optical
// depth. No receiver counts itself, or what is nearer than its bias; between two planes the look-up
// interpolates, on a ramp that does count a part of the receiver, or about the mean position that
// the moments tell. Sums in float64.
double split_error(const OpticalDepthProfiles& layers, const FineProfiles& fine,
                   const LayerLookUp& look_up = {});

// The receivers of that, for many layers of the same texels.
class FineReceivers {
   public:
    explicit FineReceivers(const FineProfiles& fine);

    double error(const OpticalDepthProfiles& layers, const LayerLookUp& look_up) const;

   private:
    struct Receiver {
        double x;           // where T is looked up
        double begin, end;  // between which its own deposit lies
        double own;         // of optical depth
        double weight = 0.0, transmittance = 1.0;
    };
    void add_texel(const FineProfiles& fine, std::size_t t);
    void add(double optical_depth, const Receiver& receiver, double in_front);

    std::vector<Receiver> receivers_;
    std::vector<std::size_t> first_;  // of each texel, and the end
    double weights_ = 0.0;            // of all, also of those that look-ups cannot miss
};

}  // namespace opacity
