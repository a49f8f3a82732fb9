#include "techniques/exact.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>

#include "map/fragments.hpp"
#include "map/lookup.hpp"
#include "opacity/core/error.hpp"

namespace opacity::techniques {
namespace {

constexpr int list_row = 4096;  // lib/fragment_list.glsl
constexpr std::int64_t most_fragments = std::int64_t{list_row} * 16384;
constexpr int sum_chunk = 16384;  // well inside the 65,535 turns that some drivers allow

// The constants of PASS_sort in exact.glsl.
enum StepKind { step_merge = 0, step_sum = 1 };
enum Source { from_unsorted = 0, from_list = 1, from_scratch = 2 };

struct Step {
    StepKind kind = step_merge;
    Source source = from_list;
    bool into_list = false;
    int run = 1;
    int chunk_begin = 0;

    Uniforms uniforms() const {
        return {{"u_step", int(kind)},          {"u_source", int(source)},
                {"u_into_list", into_list},     {"u_run", run},
                {"u_chunk_begin", chunk_begin}, {"u_chunk_end", chunk_begin + sum_chunk}};
    }
};

void check_fragments(std::int64_t total) {
    if (total > most_fragments)
        throw OutOfMemoryError("exact would keep " + std::to_string(total) +
                                   " fragments; it holds " + std::to_string(most_fragments),
                               "lower map_size, or choose bounding_opacity_maps");
}

TextureDesc list_desc(int fragments) {
    const int rows = std::max(1, (fragments + list_row - 1) / list_row);
    return {.format = Format::rgba32f, .width = list_row, .height = rows};
}

// From the unsorted entries back and forth between list and scratch, so that the last step is into
// the list.
void sort(PassContext& context, int fragments, int longest) {
    const int steps = std::max(1, int(std::bit_width(unsigned(std::max(longest, 1) - 1))));
    for (int step = 0; step < steps; ++step) {
        const bool into_list = (steps - 1 - step) % 2 == 0;
        const Source source = step == 0 ? from_unsorted : into_list ? from_scratch : from_list;
        context.dispatch(
            fragments, Step{.source = source, .into_list = into_list, .run = 1 << step}.uniforms());
    }
}

void accumulate(PassContext& context, int texels, int longest) {
    for (int begin = 0; begin < longest; begin += sum_chunk)
        context.dispatch(texels, Step{.kind = step_sum, .chunk_begin = begin}.uniforms());
}

// ---- in C++ ----

// An entry of a list: depth, optical depth (later: of it and all before it), unused.
using Entry = float4;

void count_on_cpu(PassContext& context, const ShadowInputs& inputs, const Texture& count) {
    const std::span<std::uint32_t> counts = context.memory<std::uint32_t>(count);
    for_each_fragment(inputs.fragments(context, false),
                      [&](const Fragment& fragment) { ++counts[fragment.texel]; });
}

void store_on_cpu(PassContext& context, const ShadowInputs& inputs, const Texture& first,
                  const Texture& stored, const Texture& unsorted) {
    const auto firsts = context.memory<std::uint32_t>(first);
    const auto counts = context.memory<std::uint32_t>(stored);
    const auto entries = context.memory<Entry>(unsorted);
    for_each_fragment(inputs.fragments(context, true), [&](const Fragment& f) {
        entries[firsts[f.texel] + counts[f.texel]++] = {f.depth, f.optical_depth, 0.f, 0.f};
    });
}

// The running sum of one texel's list, sorted by depth, then by optical depth.
void sort_on_cpu(std::span<Entry> list) {
    std::sort(list.begin(), list.end());
    double sum = 0.0;
    for (Entry& entry : list) entry[1] = float(sum += double(entry[1]));
}

class SortedLists : public TexelMap {
   public:
    SortedLists(std::span<const std::uint32_t> first, std::span<const std::uint32_t> count,
                std::span<const Entry> list)
        : first_{first}, count_{count}, list_{list} {}

    float optical_depth(std::size_t texel, float depth, const OwnDeposit&) const override {
        const std::span<const Entry> list = list_.subspan(first_[texel], count_[texel]);
        const auto behind = std::lower_bound(list.begin(), list.end(), depth,
                                             [](const Entry& e, float z) { return e[0] < z; });
        return behind == list.begin() ? 0.f : (*(behind - 1))[1];
    }

   private:
    std::span<const std::uint32_t> first_, count_;
    std::span<const Entry> list_;
};

}  // namespace

LookUp Exact::build(FrameGraph& graph, const ShadowInputs& inputs) {
    const Lists lists{graph.texture("count", inputs.map(Format::r32ui)),
                      graph.texture("first", inputs.map(Format::r32ui)),
                      graph.growing_texture("unsorted", Format::rgba32f),
                      graph.growing_texture("list", Format::rgba32f),
                      graph.value("fragments", 0),
                      graph.value("longest", 0)};
    add_count(graph, inputs, lists);
    add_first(graph, inputs, lists);
    add_store(graph, inputs, lists);
    add_sort(graph, inputs, lists);
    return look_up(
        inputs, {&lists.first, &lists.count, &lists.list}, [lists](PassContext& context) {
            return std::make_unique<SortedLists>(context.memory<std::uint32_t>(lists.first),
                                                 context.memory<std::uint32_t>(lists.count),
                                                 context.memory<Entry>(lists.list));
        });
}

void Exact::add_count(FrameGraph& graph, const ShadowInputs& inputs, const Lists& lists) const {
    graph.add({.name = "count",
               .shader = inputs.caster_shader(shader_path(), false, {{"PASS_count", "1"}}),
               .draws = &inputs.translucent,
               .view = &inputs.light,
               .reads = inputs.caster_reads(false),
               .stores = {&lists.count},
               .execute =
                   [&count = lists.count](PassContext& context) {
                       context.zero(count);
                       context.draw();
                   },
               .on_cpu =
                   [inputs, &count = lists.count](PassContext& context) {
                       context.zero(count);
                       count_on_cpu(context, inputs, count);
                   }});
}

// Where each texel's list begins: the sum of the counts before it.
void Exact::add_first(FrameGraph& graph, const ShadowInputs& inputs, const Lists& lists) const {
    graph.add({.name = "first",
               .only_with = &inputs.translucent,
               .reads = {&lists.count},
               .stores = {&lists.first},
               .values = {&lists.fragments, &lists.longest},
               .execute = [lists](PassContext& context) {
                   std::vector<std::uint32_t> counts = context.read<std::uint32_t>(lists.count);
                   std::int64_t total = 0, longest = 0;
                   for (std::uint32_t& entry : counts) {
                       const std::uint32_t here = entry;
                       entry = std::uint32_t(total);
                       total += here;
                       longest = std::max<std::int64_t>(longest, here);
                   }
                   check_fragments(total);
                   context.write(lists.first, std::as_bytes(std::span{counts}));
                   context.set(lists.fragments, int(total));
                   context.set(lists.longest, int(longest));
                   context.note(std::to_string(total) + " fragments, at most " +
                                std::to_string(longest) + " a texel");
               }});
}

void Exact::add_store(FrameGraph& graph, const ShadowInputs& inputs, const Lists& lists) const {
    Texture& stored = graph.texture("stored", inputs.map(Format::r32ui));
    graph.add({.name = "store",
               .shader = inputs.caster_shader(shader_path(), true, {{"PASS_store", "1"}}),
               .draws = &inputs.translucent,
               .view = &inputs.light,
               .reads = inputs.caster_reads(true, {&lists.first, &lists.count, &lists.fragments}),
               .stores = {&stored, &lists.unsorted},
               .execute =
                   [lists, &stored](PassContext& context) {
                       context.zero(stored);
                       context.resize(lists.unsorted, list_desc(lists.fragments.get()));
                       context.zero(lists.unsorted);
                       context.draw();
                   },
               .on_cpu =
                   [inputs, lists, &stored](PassContext& context) {
                       context.zero(stored);
                       context.resize(lists.unsorted, list_desc(lists.fragments.get()));
                       store_on_cpu(context, inputs, lists.first, stored, lists.unsorted);
                   }});
}

void Exact::add_sort(FrameGraph& graph, const ShadowInputs& inputs, const Lists& lists) const {
    Texture& scratch = graph.growing_texture("scratch", Format::rgba32f);
    Texture& sum = graph.texture("sum", inputs.map(Format::r32f));
    graph.add(
        {.name = "sort",
         .shader = {.compute = shader_path(), .defines = {{"PASS_sort", "1"}}},
         .only_with = &inputs.translucent,
         .reads = {&lists.first, &lists.count, &lists.unsorted, &lists.fragments, &lists.longest},
         .stores = {&lists.list, &scratch, &sum},
         .execute =
             [lists, &scratch, &sum](PassContext& context) {
                 const int fragments = lists.fragments.get(), longest = lists.longest.get();
                 context.resize(lists.list, list_desc(fragments));
                 context.resize(scratch, list_desc(fragments));
                 sort(context, fragments, longest);
                 context.resize(scratch, list_desc(0));
                 accumulate(context, sum.desc().width * sum.desc().height, longest);
             },
         .on_cpu =
             [lists](PassContext& context) {
                 context.resize(lists.list, list_desc(lists.fragments.get()));
                 const auto first = context.memory<std::uint32_t>(lists.first);
                 const auto count = context.memory<std::uint32_t>(lists.count);
                 const auto list = context.memory<Entry>(lists.list);
                 std::ranges::copy(context.memory<Entry>(lists.unsorted), list.begin());
                 parallel_for(first.size(), [&](std::size_t texel) {
                     sort_on_cpu(list.subspan(first[texel], count[texel]));
                 });
             }});
}

}  // namespace opacity::techniques
