// What a texel holds of the receiver's own caster. A map of layers spreads it over a layer, so that
// a look-up inside counts a part of it. GLSL: lib/receiver.glsl.
#pragma once

#include "map/receiver.hpp"

namespace opacity {

struct OwnDeposit {
    float depth = 0.f, depth_end = 0.f;
    float optical_depth = 0.f;  // 0: nothing
};

// Of the texel (x, y) of the receiver's face.
OwnDeposit own_deposit(const SeenReceiver& receiver, int x, int y, double depth_range);

}  // namespace opacity
