#include "techniques/exact.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>

#include "opacity/core/error.hpp"

namespace opacity::techniques {
namespace {

constexpr int list_row = 4096;  // lib/fragment_list.glsl
constexpr std::int64_t most_fragments = std::int64_t{list_row} * 16384;
constexpr int group_size = 64;
constexpr int most_groups = 32768;  // a dispatch takes 65,535 a dimension
constexpr int sum_chunk = 16384;    // well inside the 65,535 turns that some drivers allow

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

TextureDesc list_desc(int fragments) {
    const int rows = std::max(1, (fragments + list_row - 1) / list_row);
    return {.format = Format::rgba32f, .width = list_row, .height = rows};
}

void dispatch_over(PassContext& context, int count, const Step& step) {
    const int groups = (count + group_size - 1) / group_size;
    const int columns = std::min(groups, most_groups);
    if (count > 0) context.dispatch(columns, (groups + columns - 1) / columns, 1, step.uniforms());
}

}  // namespace

Reads Exact::build(FrameGraph& graph, const ShadowInputs& inputs) {
    const Lists lists{graph.texture("count", inputs.map(Format::r32ui)),
                      graph.texture("first", inputs.map(Format::r32ui)),
                      graph.growing_texture("unsorted", Format::rgba32f),
                      graph.growing_texture("list", Format::rgba32f)};
    add_count(graph, inputs, lists);
    add_store(graph, inputs, lists);
    add_sort(graph, inputs, lists);
    return {&lists.first, &lists.count, &lists.list};
}

void Exact::add_count(FrameGraph& graph, const ShadowInputs& inputs, const Lists& lists) {
    graph.add({.name = "count",
               .shader = inputs.caster_shader(shader_path(), false, {{"PASS_count", "1"}}),
               .draws = &inputs.translucent,
               .view = &inputs.light,
               .reads = inputs.caster_reads(false),
               .stores = {&lists.count},
               .execute = [&lists_count = lists.count](PassContext& context) {
                   context.zero(lists_count);
                   context.draw();
               }});
    // Where each texel's list begins: the sum of the counts before it.
    graph.add({.name = "first",
               .only_with = &inputs.translucent,
               .reads = {&lists.count},
               .stores = {&lists.first},
               .values = {&total_, &longest_},
               .execute = [this, &count = lists.count, &first = lists.first](PassContext& context) {
                   std::vector<std::uint32_t> counts = context.read<std::uint32_t>(count);
                   std::int64_t total = 0, longest = 0;
                   for (std::uint32_t& entry : counts) {
                       const std::uint32_t here = entry;
                       entry = std::uint32_t(total);
                       total += here;
                       longest = std::max<std::int64_t>(longest, here);
                   }
                   if (total > most_fragments)
                       throw OutOfMemoryError("exact would keep " + std::to_string(total) +
                                                  " fragments; it holds " +
                                                  std::to_string(most_fragments),
                                              "lower map_size, or choose bounding_opacity_maps");
                   context.write(first, std::as_bytes(std::span{counts}));
                   context.set(total_, int(total));
                   context.set(longest_, int(longest));
                   context.note(std::to_string(total) + " fragments, at most " +
                                std::to_string(longest) + " a texel");
               }});
}

void Exact::add_store(FrameGraph& graph, const ShadowInputs& inputs, const Lists& lists) {
    Texture& stored = graph.texture("stored", inputs.map(Format::r32ui));
    graph.add({.name = "store",
               .shader = inputs.caster_shader(shader_path(), true, {{"PASS_store", "1"}}),
               .draws = &inputs.translucent,
               .view = &inputs.light,
               .reads = inputs.caster_reads(true, {&lists.first, &total_}),
               .stores = {&stored, &lists.unsorted},
               .execute = [this, &stored, &unsorted = lists.unsorted](PassContext& context) {
                   context.zero(stored);
                   context.resize(unsorted, list_desc(total_.get()));
                   context.draw();
               }});
}

void Exact::add_sort(FrameGraph& graph, const ShadowInputs& inputs, const Lists& lists) {
    Texture& scratch = graph.growing_texture("scratch", Format::rgba32f);
    Texture& sum = graph.texture("sum", inputs.map(Format::r32f));
    graph.add({.name = "sort",
               .shader = {.compute = shader_path(), .defines = {{"PASS_sort", "1"}}},
               .only_with = &inputs.translucent,
               .reads = {&lists.first, &lists.count, &lists.unsorted, &total_, &longest_},
               .stores = {&lists.list, &scratch, &sum},
               .execute = [this, lists, &scratch](PassContext& context) {
                   context.resize(lists.list, list_desc(total_.get()));
                   context.resize(scratch, list_desc(total_.get()));
                   sort(context);
                   context.resize(scratch, list_desc(0));
                   accumulate(context, lists);
               }});
}

void Exact::sort(PassContext& context) const {
    const int steps = std::max(1, int(std::bit_width(unsigned(std::max(longest_.get(), 1) - 1))));
    for (int step = 0; step < steps; ++step) {
        const bool into_list = (steps - 1 - step) % 2 == 0;
        const Source source = step == 0 ? from_unsorted : into_list ? from_scratch : from_list;
        dispatch_over(context, total_.get(),
                      {.source = source, .into_list = into_list, .run = 1 << step});
    }
}

void Exact::accumulate(PassContext& context, const Lists& lists) const {
    const int texels = lists.count.desc().width * lists.count.desc().height;
    for (int begin = 0; begin < longest_.get(); begin += sum_chunk)
        dispatch_over(context, texels, {.kind = step_sum, .chunk_begin = begin});
}

}  // namespace opacity::techniques
