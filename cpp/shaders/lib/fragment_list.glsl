// Every fragment of every texel, one texel's after the other. A list is folded into rows, since a
// texture has no other way to be long, and a storage buffer ends at 128 MiB on some drivers. An
// entry: depth, optical depth (later: of it and all before it), and the texel it belongs to.

const int list_row = 4096;

ivec2 list_place(uint index) { return ivec2(index % uint(list_row), index / uint(list_row)); }
