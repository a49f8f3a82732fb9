// What changes the optical depth in front, for every texel, one texel's entries after the other. A
// list is folded into rows, since a texture has no other way to be long, and a storage buffer ends at
// 128 MiB on some drivers. Floats are stored by their bits, beside the texel that the entry belongs to.

const int list_row = 4096;

ivec2 list_place(uint index) { return ivec2(index % uint(list_row), index / uint(list_row)); }

// At a depth: a point adds optical depth, an interval a density where it begins, and takes it away
// where it ends. Later the sums of these over all entries so far.
struct Entry {
    float depth;
    float optical_depth;
    float density;  // optical depth by depth
    uint texel;     // y * width + x
};

Entry entry_of(uvec4 bits) {
    return Entry(uintBitsToFloat(bits.x), uintBitsToFloat(bits.y), uintBitsToFloat(bits.z), bits.w);
}
uvec4 bits_of(Entry entry) {
    return uvec4(floatBitsToUint(entry.depth), floatBitsToUint(entry.optical_depth),
                 floatBitsToUint(entry.density), entry.texel);
}
