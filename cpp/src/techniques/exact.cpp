#include "techniques/exact.hpp"

#include <algorithm>
#include <bit>
#include <compare>
#include <cstdint>

#include "map/fragments.hpp"
#include "map/lookup.hpp"
#include "opacity/core/error.hpp"

namespace opacity::techniques {
namespace {

constexpr int list_row = 4096;  // lib/fragment_list.glsl
constexpr std::int64_t most_entries = std::int64_t{list_row} * 16384;
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

void check_entries(std::int64_t total) {
    if (total > most_entries)
        throw OutOfMemoryError("exact would keep " + std::to_string(total) +
                                   " fragments and ends of fragments; it holds " +
                                   std::to_string(most_entries),
                               "lower map_size, or choose bounding_opacity_maps");
}

TextureDesc list_desc(int entries) {
    const int rows = std::max(1, (entries + list_row - 1) / list_row);
    return {.format = Format::rgba32ui, .width = list_row, .height = rows};
}

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

// As lib/fragment_list.glsl has it; what adds to a sum later holds it.
struct Entry {
    float depth, optical_depth, density;
    std::uint32_t texel;  // which nobody needs here
    auto operator<=>(const Entry&) const = default;
};
static_assert(sizeof(Entry) == 16);

// A shorter one is a point, as in exact.glsl.
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
    const auto entries = context.memory<Entry>(unsorted);
    for_each_fragment(inputs.fragments(context, true), [&](const Fragment& f) {
        const auto add = [&](const Entry& entry) {
            entries[firsts[f.texel] + counts[f.texel]++] = entry;
        };
        if (is_point(f)) return add({f.depth, f.optical_depth, 0.f, 0});
        const float density = f.optical_depth / (f.depth_end - f.depth);
        add({f.depth, 0.f, density, 0});
        add({f.depth_end, 0.f, -density, 0});
    });
}

// The running sums of one texel's list, sorted by depth, then by what an entry adds.
void sort_on_cpu(std::span<Entry> list) {
    std::sort(list.begin(), list.end());
    double optical_depth = 0.0, density = 0.0;
    float depth = 0.f;
    int intervals = 0;  // that have begun and not ended
    for (Entry& entry : list) {
        optical_depth += double(entry.optical_depth) + density * (double(entry.depth) - depth);
        depth = entry.depth;
        intervals += (entry.density > 0.f) - (entry.density < 0.f);
        density = intervals ? std::max(density + double(entry.density), 0.0) : 0.0;
        entry.optical_depth = float(optical_depth);
        entry.density = float(density);
    }
}

class SortedLists : public TexelMap {
   public:
    SortedLists(std::span<const std::uint32_t> first, std::span<const std::uint32_t> count,
                std::span<const Entry> list)
        : first_{first}, count_{count}, list_{list} {}

    float optical_depth(std::size_t texel, float depth, const OwnDeposit& own) const override {
        const std::span<const Entry> list = list_.subspan(first_[texel], count_[texel]);
        const auto behind = std::lower_bound(list.begin(), list.end(), depth,
                                             [](const Entry& e, float z) { return e.depth < z; });
        if (behind == list.begin()) return 0.f;
        const Entry& last = *(behind - 1);
        const float in_front = last.optical_depth + last.density * (depth - last.depth);
        return in_front - own.optical_depth * part_in_front(own.depth, own.depth_end, depth);
    }

   private:
    std::span<const std::uint32_t> first_, count_;
    std::span<const Entry> list_;
};

}  // namespace

LookUp Exact::build(FrameGraph& graph, const ShadowInputs& inputs) {
    const Lists lists{graph.texture("count", inputs.map(Format::r32ui)),
                      graph.texture("first", inputs.map(Format::r32ui)),
                      graph.growing_texture("unsorted", Format::rgba32ui),
                      graph.growing_texture("list", Format::rgba32ui),
                      graph.value("entries", 0),
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
               .values = {&lists.entries, &lists.longest},
               .execute = [lists](PassContext& context) {
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
                   context.note(std::to_string(total) + " entries, at most " +
                                std::to_string(longest) + " a texel");
               }});
}

void Exact::add_store(FrameGraph& graph, const ShadowInputs& inputs, const Lists& lists) const {
    Texture& stored = graph.texture("stored", inputs.map(Format::r32ui));
    graph.add({.name = "store",
               .shader = inputs.caster_shader(shader_path(), true, {{"PASS_store", "1"}}),
               .draws = &inputs.translucent,
               .view = &inputs.light,
               .reads = inputs.caster_reads(true, {&lists.first, &lists.count, &lists.entries}),
               .stores = {&stored, &lists.unsorted},
               .execute =
                   [lists, &stored](PassContext& context) {
                       context.zero(stored);
                       context.resize(lists.unsorted, list_desc(lists.entries.get()));
                       context.zero(lists.unsorted);
                       context.draw();
                   },
               .on_cpu =
                   [inputs, lists, &stored](PassContext& context) {
                       context.zero(stored);
                       context.resize(lists.unsorted, list_desc(lists.entries.get()));
                       store_on_cpu(context, inputs, lists.first, stored, lists.unsorted);
                   }});
}

void Exact::add_sort(FrameGraph& graph, const ShadowInputs& inputs, const Lists& lists) const {
    Texture& scratch = graph.growing_texture("scratch", Format::rgba32ui);
    Texture& sums = graph.texture("sums", inputs.map(Format::rgba32f));
    graph.add(
        {.name = "sort",
         .shader = {.compute = shader_path(), .defines = {{"PASS_sort", "1"}}},
         .only_with = &inputs.translucent,
         .reads = {&lists.first, &lists.count, &lists.unsorted, &lists.entries, &lists.longest},
         .stores = {&lists.list, &scratch, &sums},
         .execute =
             [lists, &scratch, &sums](PassContext& context) {
                 const int entries = lists.entries.get(), longest = lists.longest.get();
                 context.resize(lists.list, list_desc(entries));
                 context.resize(scratch, list_desc(entries));
                 sort(context, entries, longest);
                 context.resize(scratch, list_desc(0));
                 accumulate(context, sums.desc().width * sums.desc().height, longest);
             },
         .on_cpu =
             [lists](PassContext& context) {
                 context.resize(lists.list, list_desc(lists.entries.get()));
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
