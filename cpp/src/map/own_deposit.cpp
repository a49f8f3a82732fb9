#include "map/own_deposit.hpp"

#include "core/opacity.hpp"
#include "map/sphere.hpp"
#include "map/surface.hpp"

namespace opacity {
namespace {

// Where the surface turns away from the light nothing is known of its neighbourhood.
OwnDeposit own_surface_deposit(const SeenReceiver& receiver, float x, float y) {
    const Slope slope{receiver.direction[0], receiver.direction[1]};
    const float dx = x - receiver.p_ls[0], dy = y - receiver.p_ls[1];
    const float change = plane_change(slope, dx, dy, receiver.largest_margin);
    if (std::abs(change) >= plane_limit(dx, dy, receiver.largest_margin)) return {};
    const float depth = receiver.p_ls[2] + change;
    return {std::max(depth, 0.f), std::max(depth, 0.f), optical_depth_of(receiver.opacity)};
}

OwnDeposit own_particle_deposit(const SeenReceiver& receiver, const float2& texel,
                                float depth_range) {
    const auto coverage =
        sphere_coverage({receiver.p_ls[0], receiver.p_ls[1]}, 0.5f * receiver.width_texels,
                        optical_depth_of(receiver.opacity), profile_of(receiver), texel);
    if (!coverage) return {};
    const float half_length = coverage->half_length / (receiver.texels_per_unit * depth_range);
    const float begin = std::max(receiver.p_ls[2] - half_length, 0.f);
    const float end = std::max(receiver.p_ls[2] + half_length, begin);
    return {begin, end, optical_depth_of(coverage->opacity)};
}

}  // namespace

OwnCaster::OwnCaster(const SeenReceiver& receiver, double depth_range)
    : receiver_{receiver}, depth_range_{float(depth_range)} {
    if (!(receiver.opacity > 0.f && receiver.width_texels > 0.f) || is_at_particle(receiver))
        return;
    const auto reach = [&](float end) {
        return plus(receiver.p_ls, scaled(receiver.direction, end));
    };
    strand_.emplace(reach(receiver.ends[0]), reach(receiver.ends[1]));
}

OwnDeposit OwnCaster::strand_at(float x, float y) const {
    const float width = receiver_.width_texels;
    const auto coverage =
        ribbon_coverage(*strand_, width, width, strand_->steep ? y : x, strand_->steep ? x : y);
    if (!coverage) return {};
    const float place = std::max(coverage->depth, 0.f);
    return {place, place, coverage->along * optical_depth_of(receiver_.opacity * coverage->across)};
}

OwnDeposit OwnCaster::at(int x, int y) const {
    if (!(receiver_.opacity > 0.f)) return {};
    const float middle_x = float(x) + 0.5f, middle_y = float(y) + 0.5f;
    if (strand_) return strand_at(middle_x, middle_y);
    return is_at_particle(receiver_)
               ? own_particle_deposit(receiver_, {middle_x, middle_y}, depth_range_)
               : own_surface_deposit(receiver_, middle_x, middle_y);
}

}  // namespace opacity
