// What a layer holds, where its optical depth is known and the mean position of that. C++:
// map/layer_held.hpp.
#include "lib/interval.glsl"
#include "lib/opacity.glsl"

// Optical depth that grows evenly from one plane to the next. Rounding makes it nowhere more than
// what the next plane has: T never rises along the light.
float rising_line(float before, float behind, float along) {
    return min(before + along * (behind - before), behind);
}

// Its optical depth in front of x: it grows evenly about the mean position, as far as the nearer
// plane. Of FEW_CASTERS: the mean of T if it is that of two, each anywhere there. `held`: optical
// depth, and the same times position.
float held_in_front(vec2 held, float low, float high, float x) {
    if (!(held.x > 0.0)) return 0.0;
    float mean = clamp(held.y / held.x, low, high), reach = min(mean - low, high - mean);
    float met = part_in_front(mean - reach, mean + reach, x);
#ifdef FEW_CASTERS
    return 2.0 * optical_depth_of(met * opacity_of(0.5 * held.x));
#else
    return met * held.x;
#endif
}
