#include "techniques/deep_shadow_maps.hpp"

#include <algorithm>
#include <cstdint>
#include <memory>
#include <span>

#include "core/parallel.hpp"
#include "map/interval.hpp"
#include "map/lookup.hpp"
#include "map/transmittance_line.hpp"

namespace opacity::techniques {
namespace {

constexpr float least_transmittance = 1e-37f;  // what float32 still has a logarithm of

// Entries that one invocation compresses, so that it stays well inside the 65,535 turns of all its
// loops that some drivers allow: an entry takes up to 28, and two nodes that move all others.
int part_for(int most_nodes) {
    return 32768 / (32 + 4 * most_nodes);
}

void compress_on_gpu(PassContext& context, const FragmentLists& lists, int most_nodes) {
    const TextureDesc& map = lists.places.count.desc();
    const int part = part_for(most_nodes);
    for (int begin = 0; begin < lists.places.longest.get(); begin += part)
        context.dispatch(map.width * map.height,
                         {{"u_part_begin", begin}, {"u_part_end", begin + part}});
}

// `take` gets a texel and its nodes.
template <class Take>
void compress_on_cpu(PassContext& context, const FragmentLists& lists,
                     const Compression& compression, Take take) {
    const auto first = context.memory<std::uint32_t>(lists.places.first);
    const auto count = context.memory<std::uint32_t>(lists.places.count);
    const std::span<const ListEntry> list = context.memory<ListEntry>(lists.list);
    parallel_for(first.size(), [&](std::size_t texel) {
        take(texel, compressed(list.subspan(first[texel], count[texel]), compression));
    });
}

class NodeLists : public TexelMap {
   public:
    NodeLists(std::span<const std::uint32_t> first, std::span<const std::uint32_t> count,
              std::span<const TransmittanceNode> nodes)
        : first_{first}, count_{count}, nodes_{nodes} {}

    float optical_depth(std::size_t texel, float depth, const OwnDeposit& own) const override {
        const auto nodes = nodes_.subspan(first_[texel], count_[texel]);
        const float in_front =
            -std::log(std::max(transmittance_at(nodes, depth), least_transmittance));
        return in_front - own.optical_depth * part_in_front(own.depth, own.depth_end, depth);
    }

   private:
    std::span<const std::uint32_t> first_, count_;
    std::span<const TransmittanceNode> nodes_;
};

}  // namespace

LookUp DeepShadowMaps::build(FrameGraph& graph, const ShadowInputs& inputs) {
    const FragmentLists lists = add_fragment_lists(graph, inputs);
    const PackedLists places = packed_lists(graph, inputs, "node_");
    Texture& list = graph.growing_texture("node_list", Format::r32f);
    add_node_count(graph, inputs, lists, places.count);
    add_first(graph, inputs, "node_", places);
    add_nodes(graph, inputs, lists, places, list);
    return look_up(
        inputs, {&places.first, &places.count, &list}, [places, &list](PassContext& context) {
            return std::make_unique<NodeLists>(context.memory<std::uint32_t>(places.first),
                                               context.memory<std::uint32_t>(places.count),
                                               context.memory<TransmittanceNode>(list));
        });
}

void DeepShadowMaps::add_node_count(FrameGraph& graph, const ShadowInputs& inputs,
                                    const FragmentLists& lists, Texture& count) const {
    const int most = nodes.get();
    const Compression compression{float(error_bound.get()), most, part_for(most)};
    graph.add({.name = "node_count",
               .shader = {.compute = shader_path(), .defines = {{"PASS_node_count", "1"}}},
               .only_with = &inputs.translucent,
               .reads = {&lists.places.first, &lists.places.count, &lists.list,
                         &lists.places.longest, &error_bound, &nodes},
               .stores = {&count},
               .execute =
                   [lists, most, &count](PassContext& context) {
                       context.zero(count);
                       compress_on_gpu(context, lists, most);
                   },
               .on_cpu =
                   [lists, compression, &count](PassContext& context) {
                       const auto counts = context.memory<std::uint32_t>(count);
                       compress_on_cpu(context, lists, compression,
                                       [&](std::size_t texel, const auto& kept) {
                                           counts[texel] = std::uint32_t(kept.size());
                                       });
                   }});
}

void DeepShadowMaps::add_nodes(FrameGraph& graph, const ShadowInputs& inputs,
                               const FragmentLists& lists, const PackedLists& places,
                               Texture& list) const {
    const int most = nodes.get();
    const Compression compression{float(error_bound.get()), most, part_for(most)};
    Texture& kept = graph.texture("nodes_kept", inputs.map(Format::r32ui));
    const auto prepare = [places, &list](PassContext& context) {
        context.resize(list, list_desc(Format::r32f, 2 * std::int64_t{places.entries.get()}));
    };
    graph.add(
        {.name = "nodes",
         .shader = {.compute = shader_path(), .defines = {{"PASS_nodes", "1"}}},
         .only_with = &inputs.translucent,
         .reads = {&lists.places.first, &lists.places.count, &lists.list, &lists.places.longest,
                   &places.first, &places.entries, &error_bound, &nodes},
         .stores = {&list, &kept},
         .execute =
             [lists, most, prepare, &kept](PassContext& context) {
                 prepare(context);
                 context.zero(kept);
                 compress_on_gpu(context, lists, most);
             },
         .on_cpu =
             [lists, places, compression, prepare, &list](PassContext& context) {
                 prepare(context);
                 const auto first = context.memory<std::uint32_t>(places.first);
                 const auto all = context.memory<TransmittanceNode>(list);
                 compress_on_cpu(context, lists, compression,
                                 [&](std::size_t texel, const auto& kept) {
                                     std::ranges::copy(kept, all.begin() + first[texel]);
                                 });
             }});
}

}  // namespace opacity::techniques
