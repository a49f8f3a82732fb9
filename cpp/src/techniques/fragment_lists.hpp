// Every fragment of every texel, sorted by depth, with the running sum of optical depth: what
// `exact` looks up, and what is compressed elsewhere. Of an interval both ends are kept, with the
// density between them. Shaders: fragment_lists.glsl.
#pragma once

#include "techniques/packed_lists.hpp"

namespace opacity::techniques {

struct FragmentLists {
    PackedLists places;
    Texture& list;  // of ListEntry

    Reads reads() const { return {&places.first, &places.count, &list}; }
};

// Two passes that draw, to count and to store, and two that compute.
FragmentLists add_fragment_lists(FrameGraph& graph, const ShadowInputs& inputs);

}  // namespace opacity::techniques
