#include "render/shadow_sweep.hpp"

#include <algorithm>

namespace opacity::render {
namespace {

// A shader may round otherwise than we do here.
constexpr float margin = 1e-5f;

struct SlabRange {
    std::size_t first, last;
};

SlabRange range_of(const DepthRange& depths, std::span<const float> planes) {
    const std::size_t slabs = planes.size() - 1;
    if (!(depths.first <= depths.last)) return {0, 0};  // not a number
    const auto slab_at = [&](float depth) {
        const auto above = std::upper_bound(planes.begin() + 1, planes.end() - 1, depth);
        return std::min(std::size_t(above - planes.begin()) - 1, slabs - 1);
    };
    return {slab_at(depths.first - margin), slab_at(depths.last + margin)};
}

}  // namespace

DepthSlab slab_of(std::span<const float> planes, std::size_t i) {
    return {planes[i], planes[i + 1], i == 0, i + 2 == planes.size()};
}

// By counting: the work grows with the receivers, whatever the number of slabs.
SlabLists sorted_into_slabs(std::span<const Receiver> receivers, float width,
                            const MapLookUp& look_up, std::span<const float> planes) {
    std::vector<SlabRange> ranges;
    SlabLists lists{{}, std::vector<std::size_t>(planes.size(), 0)};
    for (const Receiver& receiver : receivers) {
        ranges.push_back(range_of(look_up.depths(receiver, width), planes));
        for (std::size_t i = ranges.back().first; i <= ranges.back().last; ++i)
            ++lists.firsts[i + 1];
    }
    for (std::size_t i = 1; i < lists.firsts.size(); ++i) lists.firsts[i] += lists.firsts[i - 1];
    lists.receivers.resize(lists.firsts.back());
    std::vector<std::size_t> next = lists.firsts;
    for (std::size_t r = 0; r < ranges.size(); ++r)
        for (std::size_t i = ranges[r].first; i <= ranges[r].last; ++i)
            lists.receivers[next[i]++] = std::uint32_t(r);
    return lists;
}

}  // namespace opacity::render
