#include "render/fragment_lists.hpp"

#include <algorithm>
#include <cstdint>
#include <tuple>

#include "core/parallel.hpp"
#include "opacity/core/error.hpp"

namespace opacity::render {
namespace {

constexpr int list_row = 4096;  // lib/fragment_list.glsl
constexpr std::int64_t most_samples = std::int64_t{list_row} * 16384;

void check_samples(std::int64_t total) {
    if (total > most_samples)
        throw OutOfMemoryError("exact compositing would keep " + std::to_string(total) +
                                   " samples; it holds " + std::to_string(most_samples),
                               "lower antialiasing or size, or set compositing to \"maps\"");
}

TextureDesc list_desc(Format format, int samples) {
    return {.format = format,
            .width = list_row,
            .height = std::max(1, (samples + list_row - 1) / list_row)};
}

struct Sample {
    float distance;
    float4 color;  // opacity in alpha
    // Equally far ones in one order, whatever that in which they arrived.
    bool operator<(const Sample& other) const {
        return std::tie(distance, color) < std::tie(other.distance, other.color);
    }
};

// Nearest first, each over what is behind it.
float4 composited(std::vector<Sample>& samples) {
    std::sort(samples.begin(), samples.end());
    float4 sum{};
    for (const Sample& sample : samples) {
        const float seen = (1.f - sum[3]) * sample.color[3];
        for (int i = 0; i < 3; ++i) sum[i] += seen * sample.color[i];
        sum[3] += seen;
    }
    return sum;
}

struct Content {
    std::vector<std::uint32_t> count, first;
    std::vector<float> colors, distances;
};

void composite(const Content& lists, std::span<float> rgba) {
    constexpr std::size_t texels_at_once = 4096;
    const std::size_t texels = lists.count.size();
    parallel_for((texels + texels_at_once - 1) / texels_at_once, [&](std::size_t part) {
        std::vector<Sample> samples;
        const std::size_t end = std::min(texels, (part + 1) * texels_at_once);
        for (std::size_t texel = part * texels_at_once; texel < end; ++texel) {
            samples.clear();
            for (std::size_t i = 0; i < lists.count[texel]; ++i) {
                const std::size_t at = lists.first[texel] + i;
                const float* c = &lists.colors[4 * at];
                samples.push_back({lists.distances[at], {c[0], c[1], c[2], c[3]}});
            }
            const float4 sum = composited(samples);
            std::copy(sum.begin(), sum.end(), &rgba[4 * texel]);
        }
    });
}

}  // namespace

void FragmentLists::add(FrameGraph& graph, const PictureInputs& inputs, const Shading& shading,
                        const Texture& solid_depth, Texture& over) {
    const Places places = add_places(graph, inputs, shading, solid_depth);
    std::vector<Lists> lists;
    Reads reads{&places.count, &places.first};
    for (std::size_t light = 0; light < inputs.lights.size(); ++light) {
        lists.push_back(add_store(graph, inputs, shading, solid_depth, places, light));
        reads.insert(reads.end(), {lists.back().colors, lists.back().distances});
    }
    graph.add({.name = "sort_samples",
               .only_with = &inputs.lists.blended,
               .reads = std::move(reads),
               .stores = {&over},
               .execute = [places, lists, &over](PassContext& context) {
                   Content content{context.read<std::uint32_t>(places.count),
                                   context.read<std::uint32_t>(places.first),
                                   {},
                                   {}};
                   const std::size_t floats = 4 * content.count.size();
                   std::vector<float> rgba(floats * lists.size());
                   for (std::size_t light = 0; light < lists.size(); ++light) {
                       content.colors = context.read<float>(*lists[light].colors);
                       content.distances = context.read<float>(*lists[light].distances);
                       composite(content, std::span{rgba}.subspan(light * floats, floats));
                   }
                   context.write(over, std::as_bytes(std::span{rgba}));
               }});
}

FragmentLists::Places FragmentLists::add_places(FrameGraph& graph, const PictureInputs& inputs,
                                                const Shading& shading,
                                                const Texture& solid_depth) const {
    TextureDesc desc = solid_depth.desc();
    desc.format = Format::r32ui;
    const Places places{graph.texture("sample_count", desc), graph.texture("first_sample", desc),
                        graph.value("samples", 0)};
    Pass count = shading.unlit_pass("count_samples", "lighting.frag.glsl", inputs.lists.blended,
                                    {{"COUNTED", "1"}, {"TRANSLUCENT", "1"}});
    count.shader.defines.emplace_back("READS_SOLID_DEPTH", "1");
    count.reads.insert(count.reads.end(), {&inputs.lists.blended.opacity, &solid_depth});
    count.tests = &solid_depth;
    count.state = {.depth = Depth::greater};
    count.stores = {&places.count};
    count.execute = [&texture = places.count](PassContext& context) {
        context.zero(texture);
        context.draw();
    };
    graph.add(std::move(count));
    graph.add({.name = "place_samples",
               .only_with = &inputs.lists.blended,
               .reads = {&places.count},
               .stores = {&places.first},
               .values = {&places.samples},
               .execute = [places](PassContext& context) {
                   std::vector<std::uint32_t> counts = context.read<std::uint32_t>(places.count);
                   std::int64_t total = 0;
                   for (std::uint32_t& entry : counts) {
                       const std::uint32_t here = entry;
                       entry = std::uint32_t(total);
                       total += here;
                   }
                   check_samples(total);
                   context.write(places.first, std::as_bytes(std::span{counts}));
                   context.set(places.samples, int(total));
                   context.note(std::to_string(total) + " samples");
               }});
    return places;
}

FragmentLists::Lists FragmentLists::add_store(FrameGraph& graph, const PictureInputs& inputs,
                                              const Shading& shading, const Texture& solid_depth,
                                              const Places& places, std::size_t light) const {
    const LightScope scope{graph, inputs, light};
    Texture& colors = graph.growing_texture("sample_colors", Format::rgba32f);
    Texture& distances = graph.growing_texture("sample_distances", Format::r32f);
    Texture& stored = graph.texture("stored_samples", places.count.desc());
    Pass pass = shading.pass("store_samples", inputs, light, inputs.lists.blended, true,
                             {{"LISTED", "1"}, {"READS_SOLID_DEPTH", "1"}});
    pass.reads.insert(pass.reads.end(),
                      {&solid_depth, &places.count, &places.first, &places.samples});
    pass.tests = &solid_depth;
    pass.state = {.depth = Depth::greater};
    pass.stores = {&stored, &colors, &distances};
    pass.execute = [places, &stored, &colors, &distances](PassContext& context) {
        context.zero(stored);
        context.resize(colors, list_desc(Format::rgba32f, places.samples.get()));
        context.resize(distances, list_desc(Format::r32f, places.samples.get()));
        context.draw();
    };
    graph.add(std::move(pass));
    return {&colors, &distances};
}

}  // namespace opacity::render
