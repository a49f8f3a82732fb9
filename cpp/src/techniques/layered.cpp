#include "techniques/layered.hpp"

#include <algorithm>
#include <bit>
#include <numbers>
#include <utility>

#include "opacity/core/error.hpp"
#include "opacity/core/split.hpp"
#include "techniques/histogram.hpp"
#include "techniques/layers_on_cpu.hpp"
#include "techniques/scattered_layers.hpp"

namespace opacity::techniques {
namespace {

// A scatter takes longer for every texel, and less for every caster: about as long as blending
// where there are so many texels for each of these (docs/performance.md).
constexpr std::size_t texels_a_caster = 32;
struct Choosing {
    bool scatters;
    std::string why;
};
Choosing choose_deposit(const ShadowInputs& inputs, const std::string& accumulator) {
    if (accumulator != "float32") return {false, "accumulator is " + accumulator};
    const std::size_t texels = std::size_t(inputs.space.width_px()) * inputs.space.height_px();
    const std::size_t casters = small_caster_count(inputs.translucent, inputs.space.strand_detail);
    return {casters * texels_a_caster >= texels, std::to_string(casters) +
                                                     " segments and particles for " +
                                                     std::to_string(texels) + " texels"};
}

// Of the passes and of the look-up.
Defines layer_defines(const DrawnLayers& drawn) {
    Defines defines;
    if (drawn.is_packed) defines.emplace_back("PACKED", "1");
    if (drawn.moments) defines.emplace_back("MEAN_DEPTHS", "1");
    if (drawn.span.end) defines.emplace_back("ENDS_AT_LAST_CASTER", "1");
    if (drawn.ignores_beyond) defines.emplace_back("BEYOND_ignore", "1");
    if (drawn.curves.ratios) {
        defines.emplace_back("CURVES", std::to_string(drawn.curves.count()));
        defines.emplace_back("REGION_PX", std::to_string(drawn.curves.region_px));
    }
    if (drawn.tiles.places) defines.emplace_back("TILE_PX", std::to_string(drawn.tiles.tile_px));
    if (drawn.kappa) defines.emplace_back("ACCUMULATOR_unorm8", "1");
    defines.push_back(drawn.image_define());
    // Few sizes, so that few programs are made.
    const int planes = drawn.planes_an_image() * drawn.map.desc().layers;
    if (planes > 64)  // lib/planes.glsl
        defines.emplace_back("MOST_LAYERS", std::to_string(std::bit_ceil(unsigned(planes))));
    return defines;
}

// An array for so many planes.
TextureDesc layers_desc(const ShadowInputs& inputs, Format format, int count,
                        bool is_packed = false) {
    return inputs.map(format, int(slot_of(count, is_packed, channels(format)).target) + 1);
}

}  // namespace

const double Layered::full_8_bits = 8.0 * std::numbers::ln2;

int Layered::accumulator_bits() const {
    return accumulator.is("unorm8") ? 8 : accumulator.is("float16") ? 16 : 32;
}

Layered::DepositWay Layered::deposit_way(FrameGraph& graph, const ShadowInputs& inputs) const {
    if (deposit.is("scatter") && !accumulator.is("float32"))
        throw ParameterError(
            name() + ".deposit = scatter sums in fixed point, not in " + accumulator.get(),
            "set accumulator to float32, or deposit to blend");
    if (!graph.runs_shaders()) return {};  // in C++ a fragment is added once in any case
    const int fine = fine_layer_count(inputs.space.width_px());
    Choosing chosen{deposit.is("scatter"), "as asked for"};
    if (deposit.is("auto")) chosen = choose_deposit(inputs, accumulator.get());
    if (!chosen.scatters) return {std::nullopt, chosen.why};
    return {Scatter{graph, inputs, std::max(layers.get(), fine)}, chosen.why};
}

LayerSpan Layered::add_bounds(FrameGraph& graph, const ShadowInputs& inputs,
                              const DepositWay& way) {
    const DepthBounds both =
        way.scatter ? scatter_both_depths(graph, *way.scatter) : add_both_depths(graph, inputs);
    return {&both.start, &both.end};
}

DrawnLayers Layered::add_layers(FrameGraph& graph, const ShadowInputs& inputs,
                                const DepositWay& way, const LayerSpan& span, Planes& planes,
                                const Options& options) const {
    const Format format = accumulator.is("unorm8")    ? Format::rgba8
                          : accumulator.is("float16") ? Format::rgba16f
                                                      : way.format();
    const TextureDesc desc = layers_desc(inputs, format, layers.get(), options.packed);
    DrawnLayers drawn{
        graph.texture("opacity", desc), planes, span, nullptr, nullptr, options.packed,
        options.ignores_beyond};
    drawn.curves = options.curves;
    drawn.tiles = options.tiles;
    if (options.mean_depths)
        drawn.moments =
            &graph.texture("moments", inputs.map(way.format(), drawn.map.desc().layers));
    if (format == Format::rgba8) {
        drawn.kappa = &graph.value("kappa", 0.f);
        drawn.kappa->set(float(options.kappa));
    }
    add_passes(graph, inputs, way, drawn, layers, 1);
    return drawn;
}

DrawnLayers Layered::add_histogram(FrameGraph& graph, const ShadowInputs& inputs,
                                   const DepositWay& way, const LayerSpan& span, double split_ratio,
                                   bool in_all_texels) const {
    const int count = fine_layer_count(inputs.space.width_px());
    auto& fine_layers = graph.value("fine/layers", 0);
    auto& fine_planes = graph.value("fine/planes", std::vector<float>{});
    fine_layers.set(count);
    fine_planes.set(layer_planes(count, split_ratio));
    const BlockSample blocks =
        in_all_texels ? BlockSample{} : searched_blocks(inputs.space.width_px());
    // What blends stands where its fragments fall; else nothing need stand between the blocks.
    const bool blends = graph.runs_shaders() && !way.scatter;
    const BlockSample kept = blends ? BlockSample{} : blocks;
    TextureDesc desc = layers_desc(inputs, way.format(), count);
    desc.width = kept.packed_px(desc.width), desc.height = kept.packed_px(desc.height);
    DrawnLayers drawn{graph.texture("histogram", desc), fine_planes, span};
    drawn.kept = kept;
    add_passes(graph, inputs, way, drawn, fine_layers, blocks.stride);
    return drawn;
}

DrawnLayers Layered::add_trial(FrameGraph& graph, const ShadowInputs& inputs, const DepositWay& way,
                               const LayerSpan& span, Planes& planes, const Source& layer_count,
                               const TilePlanes& tiles) const {
    const int count = int(planes.get().size()) - 1;
    const TextureDesc desc = layers_desc(inputs, way.format(), count);
    DrawnLayers drawn{graph.texture("opacity", desc), planes, span};
    drawn.tiles = tiles;
    add_passes(graph, inputs, way, drawn, layer_count, 1);
    return drawn;
}

void Layered::add_passes(FrameGraph& graph, const ShadowInputs& inputs, const DepositWay& way,
                         const DrawnLayers& drawn, const Source& layer_count,
                         int block_stride) const {
    Reads reads{&layer_count};
    drawn.add_to(reads);
    if (!way.scatter) {
        reads = inputs.caster_reads(true, std::move(reads));
        return add_blended(graph, inputs, way, drawn, reads, block_stride);
    }
    Defines defines = layer_defines(drawn);
    defines.insert(defines.end(), {{"PASS_opacity", "1"},
                                   {"SCATTERED", "1"},
                                   {"PLANES", "i_" + drawn.map.shader_name()},
                                   {"BLOCK_STRIDE", std::to_string(drawn.kept.stride)}});
    add_scattered_layers(graph, *way.scatter, drawn,
                         way.scatter->shader(shader_path(), true, std::move(defines)),
                         way.scatter->reads(true, std::move(reads)), way.why);
}

void Layered::add_blended(FrameGraph& graph, const ShadowInputs& inputs, const DepositWay& way,
                          const DrawnLayers& drawn, const Reads& reads, int block_stride) const {
    const int targets = drawn.map.desc().layers;
    // Only hardware has a limit.
    const int most_at_once = graph.runs_shaders() ? most_targets() : 2 * targets;
    const bool in_pairs = drawn.moments && most_at_once > 1;
    const int most = in_pairs ? most_at_once / 2 : most_at_once;
    for (int first = 0; first < targets; first += most) {
        const int count = std::min(most, targets - first);
        const std::string number = first == 0 ? "" : "_" + std::to_string(first / most + 1);
        const auto name = [&](const Texture& map) { return map.shader_name() + number; };
        add_pass(graph, inputs, drawn, {first, count, true, in_pairs},
                 {name(drawn.map), way.why, reads, block_stride});
        if (drawn.moments && !in_pairs)
            add_pass(graph, inputs, drawn, {first, count, false, true},
                     {name(*drawn.moments), way.why, reads, block_stride});
    }
}

void Layered::add_pass(FrameGraph& graph, const ShadowInputs& inputs, const DrawnLayers& drawn,
                       const LayerPart& part, const BlendedPass& pass) const {
    std::vector<Target> writes;
    Defines defines = layer_defines(drawn);
    defines.insert(defines.end(), {{"PASS_opacity", "1"},
                                   {"TARGETS", std::to_string(part.target_count)},
                                   {"FIRST_TARGET", std::to_string(part.first_target)},
                                   {"BLOCK_STRIDE", std::to_string(pass.block_stride)}});
    const auto write = [&](Texture& map, const char* define) {
        defines.emplace_back(define, "1");
        for (int i = 0; i < part.target_count; ++i)
            writes.emplace_back(&map, part.first_target + i);
    };
    if (part.planes) write(drawn.map, "WRITES_PLANES");
    if (part.moments) write(*drawn.moments, "WRITES_MOMENTS");
    const bool keeps_start = drawn.is_packed && part.planes && part.first_target == 0;
    graph.add({.name = pass.name,
               .shader = inputs.caster_shader(shader_path(), true, std::move(defines)),
               .draws = &inputs.translucent,
               .view = &inputs.light,
               .reads = pass.reads,
               .writes = std::move(writes),
               .state = {.blend = Blend::add, .largest_alpha = keeps_start},
               .execute =
                   [why = pass.why](PassContext& context) {
                       context.draw();
                       context.note("blend; " + why);
                   },
               .on_cpu = layers_on_cpu(inputs, drawn, part, pass.block_stride)});
}

Sweep Layered::layers_sweep(FrameGraph& graph, const ShadowInputs& inputs, const DrawnLayers& all,
                            Interpolation interpolation) const {
    DrawnLayers drawn{graph.texture("slices", inputs.map(Format::rgba32f)), all.planes, all.span,
                      nullptr, all.kappa};
    drawn.is_swept = true;
    LookUp look_up = layers_look_up(inputs, all, interpolation);
    std::erase(look_up.reads, &all.map);
    Shader shader = inputs.caster_shader("slice.frag.glsl", true, std::move(look_up.defines));
    shader.defines.emplace_back("SWEEP", "1");
    return {.shader = std::move(shader),
            .draws = &inputs.translucent,
            .reads = inputs.caster_reads(true, std::move(look_up.reads)),
            .map = &drawn.map,
            .planes = &drawn.planes,
            .planes_ahead = interpolation == Interpolation::cubic ? 2 : 1,
            .draw_on_cpu = plane_on_cpu(inputs, drawn),
            .on_cpu = look_up_on_cpu(drawn, interpolation)};
}

LookUp Layered::layers_look_up(const ShadowInputs& inputs, const DrawnLayers& drawn,
                               Interpolation interpolation, Reads more) const {
    more.insert(more.end(), {&drawn.map, &layers});
    if (drawn.moments) more.push_back(drawn.moments);
    drawn.add_to(more);
    LookUp result = look_up(inputs, std::move(more), look_up_on_cpu(drawn, interpolation));
    if (interpolation == Interpolation::cubic) result.defines.emplace_back("CUBIC", "1");
    if (interpolation == Interpolation::mean_depth_of_few)
        result.defines.emplace_back("FEW_CASTERS", "1");
    for (const auto& define : layer_defines(drawn)) result.defines.push_back(define);
    result.own_correction = corrects(inputs);
    return result;
}

}  // namespace opacity::techniques
