#include "opacity/core/split_error.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

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

// Looks T up in the layers of one texel.
struct LookUp {
    const OpticalDepthProfiles& layers;
    const LayerLookUp& rule;
    std::span<const float> layered, moments;

    // Optical depth there without the receiver's own.
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
        if (!rule.few_casters) return before + met * held;
        return before - 2.0 * std::log1p(met * std::expm1(-0.5 * held));
    }
    double transmittance(double x, const Own& own) const {
        const PlaneCell cell = cell_of(layers.planes, x);
        double found = others(cell, own);
        // The part of the receiver at its own place that its layer counts here.
        const double place = 0.5 * (own.begin + own.end);
        if (!rule.own_correction && cell_of(layers.planes, place).index == cell.index)
            found += own.optical_depth * cell.along;
        return std::exp(-std::max(0.0, found));
    }
};

}  // namespace

// Each fragment counts once, however opaque; a medium by its optical depth.
void FineReceivers::add(double optical_depth, const Receiver& receiver, double in_front) {
    const double own = receiver.own;
    const double weight = own > 0.0 ? optical_depth / own : optical_depth;
    weights_ += weight;
    if (!(receiver.x > 0.0)) return;  // in front of all casters: T = 1 without an error
    receivers_.push_back(receiver);
    receivers_.back().weight = weight;
    receivers_.back().transmittance = std::exp(-std::max(0.0, in_front));
}

// The profiles know that a fragment lies in its cell, but not where; the last one lies at 1.
void FineReceivers::add_texel(const FineProfiles& fine, std::size_t t) {
    const std::span<const float> exact = fine.profiles().texel(t), cells = fine.profiles().planes;
    const double bias = fine.profiles().bias(t);
    for (std::size_t k = 0; k + 1 < cells.size(); ++k) {
        const double cell = at_plane(exact, k + 1) - at_plane(exact, k);
        if (!(cell > 0.0)) continue;
        const bool is_last = k + 2 == cells.size();
        const double own = fine.fragment_of(exact, cell);
        // T = 1 on the first one, whatever the layers.
        const double others = cell - (k == 0 ? own : 0.0) - (is_last ? own : 0.0);
        if (others > 1e-6 * cell) {
            const Receiver here{0.5 * (cells[k] + cells[k + 1]) - bias, cells[k], cells[k + 1],
                                own};
            const Own spread{own, here.begin, here.end};
            add(others, here, fine.in_front(exact, here.x) - spread.in_front(here.x));
        }
        if (is_last)
            add(own, {1.0 - bias, 1.0, 1.0, own},
                bias > 0.0 ? fine.in_front(exact, 1.0 - bias) : double(exact.back()) - own);
    }
}

FineReceivers::FineReceivers(const FineProfiles& fine) {
    first_.push_back(0);
    for (std::size_t t = 0; t < fine.profiles().texel_count(); ++t) {
        if (is_covered(fine.profiles().texel(t))) add_texel(fine, t);
        first_.push_back(receivers_.size());
    }
}

double FineReceivers::error(const OpticalDepthProfiles& layers, const LayerLookUp& rule) const {
    double sum = 0.0;
    for (std::size_t t = 0; t < layers.texel_count(); ++t) {
        const LookUp look_up{layers, rule, layers.texel(t), layers.texel_moments(t)};
        double of_texel = 0.0;
        for (std::size_t i = first_[t]; i < first_[t + 1]; ++i) {
            const Receiver& receiver = receivers_[i];
            const Own own{receiver.own, receiver.begin, receiver.end};
            const double error = look_up.transmittance(receiver.x, own) - receiver.transmittance;
            of_texel += receiver.weight * error * error;
        }
        sum += of_texel;
    }
    return weights_ > 0.0 ? std::sqrt(sum / weights_) : 0.0;
}

double split_error(const OpticalDepthProfiles& layers, const FineProfiles& fine,
                   const LayerLookUp& look_up) {
    return FineReceivers{fine}.error(layers, look_up);
}

}  // namespace opacity
