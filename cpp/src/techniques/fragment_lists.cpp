#include "techniques/fragment_lists.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <span>

#include "map/fragments.hpp"

namespace opacity::techniques {
namespace {

constexpr const char* shader_file = "fragment_lists.glsl";
constexpr int sum_chunk = 16384;  // well inside the 65,535 turns that some drivers allow

// The constants of PASS_sort.
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

// From the unsorted entries back and forth between list and scratch, so that the last step is into
// the list.
void sort(PassContext& context, int entries, int longest) {
    const int steps = std::max(1, int(std::bit_width(unsigned(std::max(longest, 1) - 1))));
    for (int step = 0; step < steps; ++step) {
        const bool into_list = (steps - 1 - step) % 2 == 0;
        const Source source = step == 0 ? from_unsorted : into_list ? from_scratch : from_list;
        context.dispatch(
            entries, Step{.source = source, .into_list = into_list, .run = 1 << step}.uniforms());
    }
}

void accumulate(PassContext& context, int texels, int longest) {
    for (int begin = 0; begin < longest; begin += sum_chunk)
        context.dispatch(texels, Step{.kind = step_sum, .chunk_begin = begin}.uniforms());
}

// ---- in C++ ----

// A shorter one is a point, as in fragment_lists.glsl.
constexpr float least_interval = 1.f / 1048576.f;

bool is_point(const Fragment& fragment) {
    return !(fragment.depth_end - fragment.depth >= least_interval);
}

void count_on_cpu(PassContext& context, const ShadowInputs& inputs, const Texture& count) {
    const std::span<std::uint32_t> counts = context.memory<std::uint32_t>(count);
    for_each_fragment(inputs.fragments(context, false), [&](const Fragment& fragment) {
        counts[fragment.texel] += is_point(fragment) ? 1u : 2u;
    });
}

void store_on_cpu(PassContext& context, const ShadowInputs& inputs, const Texture& first,
                  const Texture& stored, const Texture& unsorted) {
    const auto firsts = context.memory<std::uint32_t>(first);
    const auto counts = context.memory<std::uint32_t>(stored);
    const auto entries = context.memory<ListEntry>(unsorted);
    for_each_fragment(inputs.fragments(context, true), [&](const Fragment& f) {
        const auto add = [&](const ListEntry& entry) {
            entries[firsts[f.texel] + counts[f.texel]++] = entry;
        };
        if (is_point(f)) return add({f.depth, f.optical_depth, 0.f, 0});
        const float density = f.optical_depth / (f.depth_end - f.depth);
        add({f.depth, 0.f, density, 0});
        add({f.depth_end, 0.f, -density, 0});
    });
}

// The running sums of one texel's list, sorted by depth, then by what an entry adds.
void sort_on_cpu(std::span<ListEntry> list) {
    std::sort(list.begin(), list.end());
    double optical_depth = 0.0, density = 0.0;
    float depth = 0.f;
    int intervals = 0;  // that have begun and not ended
    for (ListEntry& entry : list) {
        optical_depth += double(entry.optical_depth) + density * (double(entry.depth) - depth);
        depth = entry.depth;
        intervals += (entry.density > 0.f) - (entry.density < 0.f);
        density = intervals ? std::max(density + double(entry.density), 0.0) : 0.0;
        entry.optical_depth = float(optical_depth);
        entry.density = float(density);
    }
}

void add_count(FrameGraph& graph, const ShadowInputs& inputs, Texture& count) {
    graph.add({.name = "count",
               .shader = inputs.caster_shader(shader_file, false, {{"PASS_count", "1"}}),
               .draws = &inputs.translucent,
               .view = &inputs.light,
               .reads = inputs.caster_reads(false),
               .stores = {&count},
               .execute =
                   [&count](PassContext& context) {
                       context.zero(count);
                       context.draw();
                   },
               .on_cpu =
                   [inputs, &count](PassContext& context) {
                       context.zero(count);
                       count_on_cpu(context, inputs, count);
                   }});
}

void add_store(FrameGraph& graph, const ShadowInputs& inputs, const PackedLists& places,
               Texture& unsorted) {
    Texture& stored = graph.texture("stored", inputs.map(Format::r32ui));
    const auto prepare = [places, &stored, &unsorted](PassContext& context) {
        context.zero(stored);
        context.resize(unsorted, list_desc(Format::rgba32ui, places.entries.get()));
    };
    graph.add({.name = "store",
               .shader = inputs.caster_shader(shader_file, true, {{"PASS_store", "1"}}),
               .draws = &inputs.translucent,
               .view = &inputs.light,
               .reads = inputs.caster_reads(true, {&places.first, &places.count, &places.entries}),
               .stores = {&stored, &unsorted},
               .execute =
                   [prepare, &unsorted](PassContext& context) {
                       prepare(context);
                       context.zero(unsorted);
                       context.draw();
                   },
               .on_cpu =
                   [inputs, prepare, places, &stored, &unsorted](PassContext& context) {
                       prepare(context);
                       store_on_cpu(context, inputs, places.first, stored, unsorted);
                   }});
}

void sort_all_on_cpu(PassContext& context, const FragmentLists& lists, const Texture& unsorted) {
    const PackedLists& places = lists.places;
    context.resize(lists.list, list_desc(Format::rgba32ui, places.entries.get()));
    const auto first = context.memory<std::uint32_t>(places.first);
    const auto count = context.memory<std::uint32_t>(places.count);
    const auto list = context.memory<ListEntry>(lists.list);
    std::ranges::copy(context.memory<ListEntry>(unsorted), list.begin());
    parallel_for(first.size(),
                 [&](std::size_t texel) { sort_on_cpu(list.subspan(first[texel], count[texel])); });
}

void add_sort(FrameGraph& graph, const ShadowInputs& inputs, const FragmentLists& lists,
              Texture& unsorted) {
    Texture& scratch = graph.growing_texture("scratch", Format::rgba32ui);
    Texture& sums = graph.texture("sums", inputs.map(Format::rgba32f));
    const PackedLists& places = lists.places;
    graph.add({.name = "sort",
               .shader = {.compute = shader_file, .defines = {{"PASS_sort", "1"}}},
               .only_with = &inputs.translucent,
               .reads = {&places.first, &places.count, &unsorted, &places.entries, &places.longest},
               .stores = {&lists.list, &scratch, &sums},
               .execute =
                   [lists, &scratch, &sums](PassContext& context) {
                       const int entries = lists.places.entries.get();
                       const int longest = lists.places.longest.get();
                       context.resize(lists.list, list_desc(Format::rgba32ui, entries));
                       context.resize(scratch, list_desc(Format::rgba32ui, entries));
                       sort(context, entries, longest);
                       context.resize(scratch, list_desc(Format::rgba32ui, 0));
                       accumulate(context, sums.desc().width * sums.desc().height, longest);
                   },
               .on_cpu = [lists, &unsorted](
                             PassContext& context) { sort_all_on_cpu(context, lists, unsorted); }});
}

}  // namespace

FragmentLists add_fragment_lists(FrameGraph& graph, const ShadowInputs& inputs) {
    Texture& unsorted = graph.growing_texture("unsorted", Format::rgba32ui);
    const FragmentLists lists{packed_lists(graph, inputs, ""),
                              graph.growing_texture("list", Format::rgba32ui)};
    add_count(graph, inputs, lists.places.count);
    add_first(graph, inputs, "", lists.places);
    add_store(graph, inputs, lists.places, unsorted);
    add_sort(graph, inputs, lists, unsorted);
    return lists;
}

}  // namespace opacity::techniques
