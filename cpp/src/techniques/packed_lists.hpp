// Lists of any length, one a texel, packed one behind the other: a pass counts, this says where
// each begins, and a pass fills them.
#pragma once

#include <cstdint>
#include <string>

#include "map/fragment_list.hpp"
#include "opacity/technique.hpp"

namespace opacity::techniques {

struct PackedLists {
    Texture &count, &first;        // of each texel: how long its list is, and where it begins
    Value<int>&entries, &longest;  // of all lists together, and of the longest

    Reads places() const { return {&first, &count}; }
};

// Declares them as <prefix>count and so on.
PackedLists packed_lists(FrameGraph& graph, const ShadowInputs& inputs, const std::string& prefix);

// The pass <prefix>first: each list begins where those before it end.
void add_first(FrameGraph& graph, const ShadowInputs& inputs, const std::string& prefix,
               const PackedLists& lists);

// Rows that hold so many entries; OutOfMemoryError where no texture does.
TextureDesc list_desc(Format format, std::int64_t entries);

}  // namespace opacity::techniques
