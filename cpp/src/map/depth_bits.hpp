// A depth as a map of fewer bits would keep it: of 8 in even steps, of 16 as a half float. GLSL:
// lib/depth_bits.glsl.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

namespace opacity {

// To the nearest of 10 bits behind the first one; of two, the even. Of numbers in a half's range.
inline float rounded_to_half(float value) {
    const auto all = std::bit_cast<std::uint32_t>(value);
    return std::bit_cast<float>((all + 0xfffu + (all >> 13 & 1u)) & ~0x1fffu);
}

inline float rounded_to_8_bits(float value) {
    return std::floor(255.f * value + 0.5f) / 255.f;
}

inline float rounded_depth(float depth, int bits) {
    return bits == 8 ? rounded_to_8_bits(depth) : bits == 16 ? rounded_to_half(depth) : depth;
}

}  // namespace opacity
