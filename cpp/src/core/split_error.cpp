#include "opacity/core/split_error.hpp"

#include <algorithm>
#include <cmath>

namespace opacity {
namespace {

// The look-up of receivers that lie in one texel.
struct Receiver {
    const OpticalDepthProfiles& layers;
    std::span<const float> layered;
    const FineProfiles& fine;
    std::span<const float> exact;
    double bias;
    bool own_correction;

    double interpolated(const PlaneCell& cell) const {
        return std::lerp(at_plane(layered, cell.index), at_plane(layered, cell.index + 1),
                         cell.along);
    }
    // T of the look-up minus that of the casters, for a fragment of optical depth `own` at the
    // middle of fine cell k.
    double error_in(std::size_t k, double own) const {
        const std::span<const float> planes = fine.profiles().planes;
        const double begin = planes[k], end = planes[k + 1], x = 0.5 * (begin + end);
        if (!(x - bias > 0.0)) return 0.0;  // in front of all casters
        const PlaneCell cell = cell_of(layers.planes, x - bias);
        // The profiles know that it lies in its cell, but not where.
        const auto spread = [&](double z) {
            return std::clamp((z - begin) / (end - begin), 0.0, 1.0);
        };
        const double spread_own =
            own * std::lerp(spread(layers.planes[cell.index]),
                            spread(layers.planes[cell.index + 1]), cell.along);
        const double in_front = fine.in_front(exact, x - bias) - own * spread(x - bias);
        return error(interpolated(cell) - spread_own, in_front, own * ramp(x, cell));
    }
    double error_on_last(double own) const {
        if (!(1.0 - bias > 0.0)) return 0.0;
        const PlaneCell cell = cell_of(layers.planes, 1.0 - bias);
        const double own_ramp = own * ramp(1.0, cell);
        const double in_front =
            bias > 0.0 ? fine.in_front(exact, 1.0 - bias) : double(exact.back()) - own;
        return error(interpolated(cell) - own_ramp, in_front, own_ramp);
    }
    // The part of a caster at x that its layer counts at this place.
    double ramp(double x, const PlaneCell& at) const {
        return cell_of(layers.planes, x).index == at.index ? at.along : 0.0;
    }
    double error(double layered_others, double in_front, double own) const {
        return std::exp(-std::max(0.0, layered_others + (own_correction ? 0.0 : own))) -
               std::exp(-std::max(0.0, in_front));
    }
};

}  // namespace

double split_error(const OpticalDepthProfiles& layers, const FineProfiles& fine,
                   bool own_correction) {
    const std::span<const float> cells = fine.profiles().planes;
    double squares = 0.0, weights = 0.0;
    for (std::size_t t = 0; t < layers.texel_count(); ++t) {
        const std::span<const float> exact = fine.profiles().texel(t);
        if (!is_covered(exact)) continue;
        const Receiver look_up{layers, layers.texel(t),         fine,
                               exact,  fine.profiles().bias(t), own_correction};
        // Each fragment counts once, however opaque; a medium by its optical depth.
        const auto add = [&](double optical_depth, double own, double error) {
            const double weight = own > 0.0 ? optical_depth / own : optical_depth;
            squares += weight * error * error;
            weights += weight;
        };
        for (std::size_t k = 0; k + 1 < cells.size(); ++k) {
            const double cell = at_plane(exact, k + 1) - at_plane(exact, k);
            if (!(cell > 0.0)) continue;
            const double own = fine.fragment_of(exact, cell);
            // T = 1 on the first one, whatever the layers.
            const double others = cell - (k == 0 ? own : 0.0) - (k + 2 == cells.size() ? own : 0.0);
            if (others > 1e-6 * cell) add(others, own, look_up.error_in(k, own));
            if (k + 2 == cells.size()) add(own, own, look_up.error_on_last(own));
        }
    }
    return weights > 0.0 ? std::sqrt(squares / weights) : 0.0;
}

}  // namespace opacity
