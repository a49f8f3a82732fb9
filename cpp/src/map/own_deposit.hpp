// What a texel holds of the receiver's own caster. A map of layers spreads it over a layer, so that
// a look-up inside counts a part of it. GLSL: lib/receiver.glsl.
#pragma once

#include <optional>

#include "map/receiver.hpp"
#include "map/ribbon.hpp"

namespace opacity {

struct OwnDeposit {
    float depth = 0.f, depth_end = 0.f;
    float optical_depth = 0.f;  // 0: nothing
};

// What of it lies in front of a depth, and counts as any other caster does. A particle never does.
inline float own_in_front(const OwnDeposit& own, float depth) {
    return own.depth_end > own.depth || own.depth >= depth ? 0.f : own.optical_depth;
}

// What is found once for all texels about a receiver, which outlives it.
class OwnCaster {
   public:
    OwnCaster(const SeenReceiver& receiver, double depth_range);
    // Of the texel (x, y) of the receiver's face.
    OwnDeposit at(int x, int y) const;

   private:
    OwnDeposit strand_at(float x, float y) const;

    const SeenReceiver& receiver_;
    float depth_range_;
    std::optional<MajorSegment> strand_;  // as far as any filter reaches
};

inline OwnDeposit own_deposit(const SeenReceiver& receiver, int x, int y, double depth_range) {
    return OwnCaster{receiver, depth_range}.at(x, y);
}

}  // namespace opacity
