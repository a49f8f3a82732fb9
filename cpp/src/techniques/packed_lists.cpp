#include "techniques/packed_lists.hpp"

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "opacity/core/error.hpp"

namespace opacity::techniques {
namespace {

constexpr std::int64_t most_entries = std::int64_t{list_row} * 16384;

void check_entries(std::int64_t total) {
    if (total > most_entries)
        throw OutOfMemoryError("the lists of the map's texels would hold " + std::to_string(total) +
                                   " entries; they hold at most " + std::to_string(most_entries),
                               "lower map_size, or choose bounding_opacity_maps");
}

// Of counts to the sums of those before; notes what they add up to.
void place(PassContext& context, const PackedLists& lists) {
    std::vector<std::uint32_t> counts = context.read<std::uint32_t>(lists.count);
    std::int64_t total = 0, longest = 0;
    for (std::uint32_t& entry : counts) {
        const std::uint32_t here = entry;
        entry = std::uint32_t(total);
        total += here;
        longest = std::max<std::int64_t>(longest, here);
    }
    check_entries(total);
    context.write(lists.first, std::as_bytes(std::span{counts}));
    context.set(lists.entries, int(total));
    context.set(lists.longest, int(longest));
    context.note(std::to_string(total) + " entries, at most " + std::to_string(longest) +
                 " a texel");
}

}  // namespace

PackedLists packed_lists(FrameGraph& graph, const ShadowInputs& inputs, const std::string& prefix) {
    return {graph.texture(prefix + "count", inputs.map(Format::r32ui)),
            graph.texture(prefix + "first", inputs.map(Format::r32ui)),
            graph.value(prefix + "entries", 0), graph.value(prefix + "longest", 0)};
}

void add_first(FrameGraph& graph, const ShadowInputs& inputs, const std::string& prefix,
               const PackedLists& lists) {
    graph.add({.name = prefix + "first",
               .only_with = &inputs.translucent,
               .reads = {&lists.count},
               .stores = {&lists.first},
               .values = {&lists.entries, &lists.longest},
               .execute = [lists](PassContext& context) { place(context, lists); }});
}

TextureDesc list_desc(Format format, std::int64_t entries) {
    check_entries(entries);
    const std::int64_t rows = std::max<std::int64_t>(1, (entries + list_row - 1) / list_row);
    return {.format = format, .width = list_row, .height = int(rows)};
}

}  // namespace opacity::techniques
