#include "techniques/bounding_opacity_maps.hpp"

#include <algorithm>
#include <cstdio>

#include "opacity/core/split.hpp"
#include "techniques/layers_on_cpu.hpp"

namespace opacity::techniques {
namespace {

constexpr int targets_per_pass = 8;  // what OpenGL 4.5 guarantees

// The histogram that the split search reads back. Cells are laid at ratio .5: fine near the light,
// where a logarithmic split puts its planes, and fine enough behind. Larger maps have texels enough
// to take fewer cells.
constexpr double fine_ratio = 0.5;
int fine_layer_count(int map_size_px) {
    return map_size_px <= 1024 ? 64 : map_size_px <= 2048 ? 32 : 16;
}

// Texels that the search looks at: those of a map of this size, spread over the whole, and of those
// with casters so many.
constexpr int sampled_size_px = 128;
constexpr std::size_t sampled_texels = 4096;

// Channel c of layer t is plane 4 t + c + 1; the read-back holds one image a layer.
std::vector<float> sample_profiles(const std::vector<float>& targets, std::size_t texel_count,
                                   int layers) {
    const auto plane = [&](std::size_t texel, int k) {
        return targets[(std::size_t(k / planes_per_target) * texel_count + texel) *
                           planes_per_target +
                       k % planes_per_target];
    };
    std::vector<std::size_t> covered;
    for (std::size_t texel = 0; texel < texel_count; ++texel)
        if (plane(texel, layers - 1) > 0.f) covered.push_back(texel);
    const std::size_t stride = std::max<std::size_t>(1, covered.size() / sampled_texels);
    std::vector<float> profiles;
    for (std::size_t i = 0; i < covered.size(); i += stride)
        for (int k = 0; k < layers; ++k) profiles.push_back(plane(covered[i], k));
    return profiles;
}

}  // namespace

LookUp BoundingOpacityMaps::build(FrameGraph& graph, const ShadowInputs& inputs) {
    const Bounds bounds = add_bounds(graph, inputs);
    auto& planes = graph.value("planes", std::vector<float>{});
    if (split.is("auto") && layers.get() > 1)
        add_search(graph, inputs, bounds, planes);
    else
        planes.set(layer_planes(layers.get(), fixed_ratio()));
    Texture& opacity = add_layers(graph, inputs, bounds, "opacity", {layers, planes, layers.get()});
    LookUp result = look_up(inputs, {&bounds.start, &bounds.end, &opacity, &layers, &planes},
                            layers_look_up({bounds.start, bounds.end, opacity, planes}));
    result.own_correction = own_correction.get() && !inputs.paper_deposit;
    return result;
}

// One layer has no plane to place.
double BoundingOpacityMaps::fixed_ratio() const {
    return split.is("logarithmic") ? 1.0 : split.is("hybrid") ? split_ratio.get() : 0.0;
}

BoundingOpacityMaps::Bounds BoundingOpacityMaps::add_bounds(FrameGraph& graph,
                                                            const ShadowInputs& inputs) const {
    Texture& start = graph.texture("start", inputs.map(Format::depth32f));
    Texture& end = graph.texture("end", inputs.map(Format::depth32f));
    const Shader shader = inputs.caster_shader("bounds.frag.glsl", false);
    const Reads reads = inputs.caster_reads(false);
    graph.add({.name = "start_depth",
               .shader = shader,
               .draws = &inputs.translucent,
               .view = &inputs.light,
               .reads = reads,
               .writes = {&start},
               .state = {.depth = Depth::less, .clear_depth = 1.f},
               .on_cpu = first_depth_on_cpu(inputs, start)});
    graph.add({.name = "end_depth",  // reversed: the farthest caster wins
               .shader = shader,
               .draws = &inputs.translucent,
               .view = &inputs.light,
               .reads = reads,
               .writes = {&end},
               .state = {.depth = Depth::greater, .clear_depth = 0.f},
               .on_cpu = last_depth_on_cpu(inputs, end)});
    return {start, end};
}

Texture& BoundingOpacityMaps::add_layers(FrameGraph& graph, const ShadowInputs& inputs,
                                         const Bounds& bounds, const std::string& name,
                                         const Planes& planes, int block_stride) const {
    const int target_count = (planes.count + planes_per_target - 1) / planes_per_target;
    Texture& map = graph.texture(name, inputs.map(Format::rgba32f, target_count));
    const Reads reads =
        inputs.caster_reads(true, {&planes.layers, &planes.planes, &bounds.start, &bounds.end});
    for (int first = 0; first < target_count; first += targets_per_pass) {
        const int count = std::min(targets_per_pass, target_count - first);
        std::vector<Target> writes;
        for (int target = first; target < first + count; ++target)
            writes.emplace_back(&map, target);
        const std::string part =
            first == 0 ? "" : "_" + std::to_string(first / targets_per_pass + 1);
        const Defines defines{{"PASS_opacity", "1"},
                              {"TARGETS", std::to_string(count)},
                              {"FIRST_TARGET", std::to_string(first)},
                              {"BLOCK_STRIDE", std::to_string(block_stride)}};
        graph.add({.name = name + part,
                   .shader = inputs.caster_shader(shader_path(), true, defines),
                   .draws = &inputs.translucent,
                   .view = &inputs.light,
                   .reads = reads,
                   .writes = std::move(writes),
                   .state = {.blend = Blend::add},
                   .on_cpu = layers_on_cpu(inputs, {bounds.start, bounds.end, map, planes.planes},
                                           first, count, block_stride)});
    }
    return map;
}

void BoundingOpacityMaps::add_search(FrameGraph& graph, const ShadowInputs& inputs,
                                     const Bounds& bounds,
                                     Value<std::vector<float>>& planes) const {
    const int count = fine_layer_count(inputs.space.map_size_px);
    auto& fine_layers = graph.value("fine/layers", 0);
    auto& fine_planes = graph.value("fine/planes", std::vector<float>{});
    fine_layers.set(count);
    fine_planes.set(layer_planes(count, fine_ratio));
    Texture& histogram =
        add_layers(graph, inputs, bounds, "histogram", {fine_layers, fine_planes, count},
                   std::max(1, inputs.space.map_size_px / sampled_size_px));
    graph.add(
        {.name = "split_search",
         .only_with = &inputs.translucent,
         .reads = {&histogram, &fine_planes, &layers, &search_request_},
         .values = {&planes},
         .execute = [this, &histogram, &fine_planes, &planes](PassContext& context) {
             const TextureDesc& map = histogram.desc();
             const std::vector<float> profiles = sample_profiles(
                 context.read<float>(histogram), std::size_t(map.width) * map.height,
                 int(fine_planes.get().size()) - 1);
             const double ratio = find_split_ratio({fine_planes.get(), profiles}, layers.get());
             context.set(planes, layer_planes(layers.get(), ratio));
             char text[32];
             std::snprintf(text, sizeof text, "split ratio %.1f", ratio);
             context.note(text);
         }});
}

}  // namespace opacity::techniques
