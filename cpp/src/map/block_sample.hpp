// A part of a map's texels, spread over the whole: one block of 4 x 4 in every `stride`, both ways;
// and those blocks side by side. GLSL: lib/block_sample.glsl.
#pragma once

#include <algorithm>

namespace opacity {

struct BlockSample {
    static constexpr int block_px = 4;
    int stride = 1;  // all

    // Along each side.
    bool holds(int i) const { return stride == 1 || i / block_px % stride == 0; }
    bool holds(int x, int y) const { return holds(x) && holds(y); }
    // Its blocks side by side: so many texels of a side, where one of the map stands among them,
    // and the way back.
    int packed_px(int side_px) const {
        const int pitch = block_px * stride;
        return side_px / pitch * block_px + std::min(side_px % pitch, block_px);
    }
    int packed(int i) const { return i / (block_px * stride) * block_px + i % block_px; }
    int unpacked(int i) const { return i / block_px * (block_px * stride) + i % block_px; }
};

}  // namespace opacity
