#include "techniques/sampled_texels.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "core/parallel.hpp"

namespace opacity::techniques {
namespace {

// The form in C++ of sampled_texels.comp.glsl.
void copy_texels(PassContext& context, const Texture& map, const Texture& sampled,
                 const BlockSample& blocks) {
    const auto from = context.memory<float>(map), to = context.memory<float>(sampled);
    const auto width = std::size_t(map.desc().width), height = std::size_t(map.desc().height);
    const auto across = std::size_t(sampled.desc().width),
               down = std::size_t(sampled.desc().height);
    const auto channel_count = std::size_t(channels(map.desc().format));
    const std::size_t rows = down * std::size_t(std::max(map.desc().layers, 1));
    parallel_for(rows, [&](std::size_t row) {
        const auto y = std::size_t(blocks.unpacked(int(row % down)));
        for (std::size_t x = 0; x < across; ++x) {
            const std::size_t there =
                (row / down * height + y) * width + std::size_t(blocks.unpacked(int(x)));
            std::copy_n(&from[there * channel_count], channel_count,
                        &to[(row * across + x) * channel_count]);
        }
    });
}

}  // namespace

Texture& add_sampled_texels(FrameGraph& graph, const ShadowInputs& inputs, Texture& map,
                            const BlockSample& blocks) {
    if (blocks.stride == 1) return map;
    const TextureDesc& whole = map.desc();
    const bool has_one_channel = channels(whole.format) == 1;
    const std::string name = "sampled_" + map.shader_name();
    Texture& sampled =
        graph.texture(name, {.format = has_one_channel ? Format::r32f : Format::rgba32f,
                             .width = blocks.packed_px(whole.width),
                             .height = blocks.packed_px(whole.height),
                             .layers = whole.layers});
    Defines defines{{"MAP", "t_" + map.shader_name()},
                    {"SAMPLED", "i_" + name},
                    {"FORMAT", has_one_channel ? "r32f" : "rgba32f"},
                    {"BLOCK_STRIDE", std::to_string(blocks.stride)}};
    if (whole.layers > 0) defines.emplace_back("ARRAY", "1");
    graph.add(
        {.name = name,
         .shader = {.compute = "sampled_texels.comp.glsl", .defines = std::move(defines)},
         .only_with = &inputs.translucent,
         .reads = {&map},
         .stores = {&sampled},
         .execute = [count = sampled.desc().width * sampled.desc().height](
                        PassContext& context) { context.dispatch(count); },
         .on_cpu = [&map, &sampled,
                    blocks](PassContext& context) { copy_texels(context, map, sampled, blocks); }});
    return sampled;
}

}  // namespace opacity::techniques
