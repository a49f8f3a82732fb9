// A caster with extent along the light: its optical depth grows evenly from where the light enters
// it to where it leaves. GLSL: lib/interval.glsl.
#pragma once

#include <algorithm>

namespace opacity {

// The part of it in front of a depth. A point, whose begin is its end, is in front of what lies
// strictly behind it.
inline float part_in_front(float begin, float end, float depth) {
    if (end > begin) return std::clamp((depth - begin) / (end - begin), 0.f, 1.f);
    return depth > begin ? 1.f : 0.f;
}

}  // namespace opacity
