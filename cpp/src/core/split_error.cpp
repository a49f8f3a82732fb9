#include "opacity/core/split_error.hpp"

#include <algorithm>
#include <cmath>

namespace opacity {
namespace {

// A receiver's own deposit, spread evenly over some depth.
struct Own {
    double optical_depth, begin, end;

    double in_front(double z) const {
        return optical_depth *
               (end > begin ? std::clamp((z - begin) / (end - begin), 0.0, 1.0) : double(z >= end));
    }
    double moment_in_front(double z) const {
        return in_front(z) * 0.5 * (begin + std::clamp(z, begin, end));
    }
};

// The look-up of receivers that lie in one texel.
struct Receiver {
    const OpticalDepthProfiles& layers;
    std::span<const float> layered, moments;
    const FineProfiles& fine;
    std::span<const float> exact;
    double bias;
    const LayerLookUp& look_up;

    // What the look-up finds there without the receiver's own deposit.
    double others(const PlaneCell& cell, const Own& own) const {
        const double low = layers.planes[cell.index], high = layers.planes[cell.index + 1];
        const double before = at_plane(layered, cell.index) - own.in_front(low);
        const double behind = at_plane(layered, cell.index + 1) - own.in_front(high);
        if (moments.empty()) return std::lerp(before, behind, cell.along);
        const double held = behind - before;
        if (!(held > 0.0)) return before;
        const double moment = at_plane(moments, cell.index + 1) - own.moment_in_front(high) -
                              at_plane(moments, cell.index) + own.moment_in_front(low);
        const double mean = std::clamp(moment / held, low, high);
        const double reach = std::max(std::min(mean - low, high - mean), 1e-9);
        const double x = std::lerp(low, high, cell.along);
        const double met = std::clamp((x - mean + reach) / (2.0 * reach), 0.0, 1.0);
        if (!look_up.few_casters) return before + met * held;
        return before - 2.0 * std::log1p(met * std::expm1(-0.5 * held));
    }
    // T of the look-up minus that of the casters, for a fragment of optical depth `own` at the
    // middle of fine cell k.
    double error_in(std::size_t k, double own) const {
        const std::span<const float> planes = fine.profiles().planes;
        const double begin = planes[k], end = planes[k + 1], x = 0.5 * (begin + end);
        if (!(x - bias > 0.0)) return 0.0;  // in front of all casters
        const PlaneCell cell = cell_of(layers.planes, x - bias);
        // The profiles know that it lies in its cell, but not where.
        const Own spread{own, begin, end};
        const double in_front = fine.in_front(exact, x - bias) - spread.in_front(x - bias);
        return error(others(cell, spread), in_front, own * ramp(x, cell));
    }
    double error_on_last(double own) const {
        if (!(1.0 - bias > 0.0)) return 0.0;
        const PlaneCell cell = cell_of(layers.planes, 1.0 - bias);
        const double in_front =
            bias > 0.0 ? fine.in_front(exact, 1.0 - bias) : double(exact.back()) - own;
        return error(others(cell, {own, 1.0, 1.0}), in_front, own * ramp(1.0, cell));
    }
    // The part of a caster at x that its layer counts at this place.
    double ramp(double x, const PlaneCell& at) const {
        return cell_of(layers.planes, x).index == at.index ? at.along : 0.0;
    }
    double error(double layered_others, double in_front, double own) const {
        return std::exp(-std::max(0.0, layered_others + (look_up.own_correction ? 0.0 : own))) -
               std::exp(-std::max(0.0, in_front));
    }
};

}  // namespace

double split_error(const OpticalDepthProfiles& layers, const FineProfiles& fine,
                   const LayerLookUp& look_up) {
    const std::span<const float> cells = fine.profiles().planes;
    double squares = 0.0, weights = 0.0;
    for (std::size_t t = 0; t < layers.texel_count(); ++t) {
        const std::span<const float> exact = fine.profiles().texel(t);
        if (!is_covered(exact)) continue;
        const Receiver receiver{layers, layers.texel(t), layers.texel_moments(t),
                                fine,   exact,           fine.profiles().bias(t),
                                look_up};
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
            if (others > 1e-6 * cell) add(others, own, receiver.error_in(k, own));
            if (k + 2 == cells.size()) add(own, own, receiver.error_on_last(own));
        }
    }
    return weights > 0.0 ? std::sqrt(squares / weights) : 0.0;
}

}  // namespace opacity
