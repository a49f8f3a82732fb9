#include "map/split_score.hpp"

#include <algorithm>
#include <cmath>

#include "core/opacity.hpp"
#include "map/depth_bits.hpp"

namespace opacity {
namespace {

// Where layer k ends; the last one is closed.
float layer_end(std::span<const float> planes, std::size_t k) {
    return k + 2 < planes.size() ? planes[k + 1] : 2.f;
}

// What a look-up makes of a layer, where the receiver's own caster is left out.
float looked_up(const SplitMeasure& measure, const LayerHeld& held, float low, float high,
                float x) {
    if (measure.has_moments) return held_in_front(held, low, high, x, measure.look_up.few_casters);
    return held.optical_depth * std::clamp((x - low) / (high - low), 0.f, 1.f);
}

// What two neighbouring opacity images differ by.
float difference(bool in_paper, float nearer, float farther) {
    if (!in_paper) return opacity_of(farther) - opacity_of(nearer);
    return rounded_to_8_bits(std::min(farther, 1.f)) - rounded_to_8_bits(std::min(nearer, 1.f));
}

}  // namespace

FineTexel::FineTexel(std::span<const float> cells, std::span<const float> sums, float bias)
    : cells_{cells}, count_{sums.size()}, bias_{bias}, optical_depth_{sums.back()} {
    for (std::size_t k = 0; k < count_; ++k) held_[k] = sums[k] - (k > 0 ? sums[k - 1] : 0.f);
    float in_front = 0.f;
    std::size_t caster = 0;
    for (std::size_t receiver = 0; receiver < count_; ++receiver) {
        const float x = place_of(receiver) - bias_;
        for (; caster < count_ && place_of(caster) < x; ++caster) in_front += held_[caster];
        transmittance_[receiver] = std::exp(-in_front);
    }
}

float FineTexel::place_of(std::size_t cell) const {
    if (cell == 0) return 0.f;
    return cell + 1 == count_ ? 1.f : 0.5f * (cells_[cell] + cells_[cell + 1]);
}

LayerHeld FineTexel::held_by(std::span<const float> planes, std::size_t k,
                             std::size_t& caster) const {
    LayerHeld held;
    for (; caster < count_ && place_of(caster) < layer_end(planes, k); ++caster) {
        held.optical_depth += held_[caster];
        held.moment += held_[caster] * place_of(caster);
    }
    return held;
}

float FineTexel::score(const SplitMeasure& measure, std::span<const float> planes) const {
    if (measure.similarity == Similarity::error) return square_error(measure, planes);
    return lack(measure.similarity == Similarity::paper_absolute_difference, planes);
}

float FineTexel::square_error(const SplitMeasure& measure, std::span<const float> planes) const {
    float sum = 0.f, before = 0.f;
    std::size_t caster = 0, receiver = 0;
    for (std::size_t k = 0; k + 1 < planes.size(); ++k) {
        const std::size_t first = caster;
        const LayerHeld held = held_by(planes, k, caster);
        for (; receiver < count_; ++receiver) {
            const float x = place_of(receiver) - bias_;
            if (!(x < layer_end(planes, k))) break;
            if (!(held_[receiver] > 0.f)) continue;
            LayerHeld others = held;
            if (measure.look_up.own_correction && receiver >= first && receiver < caster) {
                others.optical_depth -= held_[receiver];
                others.moment -= held_[receiver] * place_of(receiver);
            }
            const float found = before + looked_up(measure, others, planes[k], planes[k + 1], x);
            const float error = std::exp(-found) - transmittance_[receiver];
            sum += held_[receiver] * error * error;
        }
        before += held.optical_depth;
    }
    return sum;
}

float FineTexel::lack(bool in_paper, std::span<const float> planes) const {
    float smallest = 1.f, sum = 0.f, before = 0.f;
    std::size_t caster = 0;
    for (std::size_t k = 0; k + 1 < planes.size(); ++k) {
        const float behind = before + held_by(planes, k, caster).optical_depth;
        smallest = std::min(smallest, difference(in_paper, before, behind));
        if (k > 0) sum += difference(in_paper, before, behind);
        before = behind;
    }
    return before * (1.f - (in_paper ? sum : smallest));
}

}  // namespace opacity
