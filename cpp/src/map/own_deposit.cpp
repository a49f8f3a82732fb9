#include "map/own_deposit.hpp"

#include "core/opacity.hpp"
#include "map/ribbon.hpp"
#include "map/surface.hpp"

namespace opacity {
namespace {

OwnDeposit own_strand_deposit(const Receiver& receiver, float x, float y) {
    const auto reach = [&](float end) {
        float3 p;
        for (int axis = 0; axis < 3; ++axis)
            p[axis] = receiver.p_ls[axis] + end * receiver.direction[axis];
        return p;
    };
    const MajorSegment strand{reach(receiver.ends[0]), reach(receiver.ends[1])};
    const auto coverage = ribbon_coverage(strand, receiver.width_texels, receiver.width_texels,
                                          strand.steep ? y : x, strand.steep ? x : y);
    if (!coverage) return {};
    const float place = std::max(coverage->depth, 0.f);
    return {place, place,
            coverage->along * optical_depth_of(receiver.opacity * coverage->across)};
}

// Where the surface turns away from the light nothing is known of its neighbourhood.
OwnDeposit own_surface_deposit(const SeenReceiver& receiver, float x, float y) {
    const Slope slope{receiver.direction[0], receiver.direction[1]};
    const float margin = surface_margin(slope, receiver.largest_margin);
    if (margin >= receiver.largest_margin) return {};
    const float depth = receiver.p_ls[2] +
                        (slope[0] * (x - receiver.p_ls[0]) + slope[1] * (y - receiver.p_ls[1])) +
                        margin;
    return {std::max(depth, 0.f), std::max(depth, 0.f), optical_depth_of(receiver.opacity)};
}

}  // namespace

OwnDeposit own_deposit(const SeenReceiver& receiver, int x, int y) {
    if (!(receiver.opacity > 0.f)) return {};
    const float middle_x = float(x) + 0.5f, middle_y = float(y) + 0.5f;
    return receiver.width_texels > 0.f ? own_strand_deposit(receiver, middle_x, middle_y)
                                       : own_surface_deposit(receiver, middle_x, middle_y);
}

}  // namespace opacity
