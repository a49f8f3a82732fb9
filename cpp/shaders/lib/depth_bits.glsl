// A depth as a map of fewer bits would keep it: of 8 in even steps, of 16 as a half float. C++:
// map/depth_bits.hpp.

float rounded_depth(float depth, int bits) {
    if (bits == 8) return floor(255.0 * depth + 0.5) / 255.0;
    if (bits != 16) return depth;
    uint all = floatBitsToUint(depth);  // to the nearest of 10 bits behind the first one; of two, the even
    return uintBitsToFloat((all + 0xfffu + (all >> 13 & 1u)) & ~0x1fffu);
}
