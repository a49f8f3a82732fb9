// A part of a map's texels, spread over the whole: one block of 4 x 4 in every BLOCK_STRIDE, both ways;
// and those blocks side by side. C++: map/block_sample.hpp.
const int block_px = 4;

bool is_sampled(ivec2 texel) { return all(equal(texel / block_px % BLOCK_STRIDE, ivec2(0))); }

// Where a texel of the map stands among the blocks, and the way back.
ivec2 packed_place(ivec2 texel) { return texel / (block_px * BLOCK_STRIDE) * block_px + texel % block_px; }
ivec2 unpacked_texel(ivec2 place) { return place / block_px * (block_px * BLOCK_STRIDE) + place % block_px; }
