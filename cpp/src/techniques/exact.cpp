#include "techniques/exact.hpp"

#include <algorithm>
#include <cstdint>
#include <memory>
#include <span>

#include "map/interval.hpp"
#include "map/lookup.hpp"
#include "techniques/fragment_lists.hpp"

namespace opacity::techniques {
namespace {

class SortedLists : public TexelMap {
   public:
    SortedLists(std::span<const std::uint32_t> first, std::span<const std::uint32_t> count,
                std::span<const ListEntry> list)
        : first_{first}, count_{count}, list_{list} {}

    float optical_depth(std::size_t texel, float depth, const OwnDeposit& own) const override {
        const std::span<const ListEntry> list = list_.subspan(first_[texel], count_[texel]);
        const auto behind =
            std::lower_bound(list.begin(), list.end(), depth,
                             [](const ListEntry& e, float z) { return e.depth < z; });
        if (behind == list.begin()) return 0.f;
        const ListEntry& last = *(behind - 1);
        const float in_front = last.optical_depth_at(depth);
        return in_front - own.optical_depth * part_in_front(own.depth, own.depth_end, depth);
    }

   private:
    std::span<const std::uint32_t> first_, count_;
    std::span<const ListEntry> list_;
};

}  // namespace

LookUp Exact::build(FrameGraph& graph, const ShadowInputs& inputs) {
    const FragmentLists lists = add_fragment_lists(graph, inputs);
    return look_up(inputs, lists.reads(), [lists](PassContext& context) {
        return std::make_unique<SortedLists>(context.memory<std::uint32_t>(lists.places.first),
                                             context.memory<std::uint32_t>(lists.places.count),
                                             context.memory<ListEntry>(lists.list));
    });
}

}  // namespace opacity::techniques
