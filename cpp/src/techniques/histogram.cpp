#include "techniques/histogram.hpp"

#include <algorithm>

#include "core/parallel.hpp"

namespace opacity::techniques {
namespace {

// Texels that a search looks at: those of a map of this size, spread over the whole, and of those
// so many with casters, with the empty ones between them.
constexpr int sampled_size_px = 128;
constexpr std::size_t most_sampled = 4096;

int moment_images(const DrawnLayers& drawn) {
    return drawn.moments ? drawn.moments->desc().layers : 0;
}

bool has_span(const DrawnLayers& drawn) {
    return drawn.span.start && drawn.span.end;
}

// What the images of sampled layers hold, by texel.
struct ReadBack {
    const SampledLayers& sampled;
    const DrawnLayers& drawn;
    std::vector<float> images;
    int width_px, height_px;

    ReadBack(PassContext& context, const SampledLayers& layers)
        : sampled{layers},
          drawn{sampled.drawn},
          images{context.read<float>(sampled.texels)},
          width_px{sampled.texels.desc().width},
          height_px{sampled.texels.desc().height} {}

    float plane(std::size_t texel, int k) const {
        const Slot slot = drawn.slot_of(k);
        return drawn.unit() * at(texel, slot.target, slot.channel);
    }
    float moment(std::size_t texel, int k) const {
        const Slot slot = drawn.slot_of(k);
        return at(texel, std::size_t(drawn.map.desc().layers) + slot.target, slot.channel);
    }
    float depth_range(std::size_t texel) const {
        const auto image = std::size_t(drawn.map.desc().layers + moment_images(drawn));
        return at(texel, image, 1) - at(texel, image, 0);
    }
    std::vector<std::size_t> chosen() const;

   private:
    float at(std::size_t texel, std::size_t image, std::size_t channel) const {
        const std::size_t count = std::size_t(width_px) * height_px;
        return images[(image * count + texel) * planes_per_target + channel];
    }
};

std::vector<std::size_t> ReadBack::chosen() const {
    const BlockSample blocks = sampled.blocks();
    std::vector<std::size_t> texels;
    std::size_t covered = 0;
    for (int y = 0; y < height_px; ++y)
        for (int x = 0; x < width_px; ++x) {
            if (blocks.unpacked(x) >= sampled.map_width_px ||
                blocks.unpacked(y) >= sampled.map_height_px)
                continue;
            texels.push_back(std::size_t(y) * width_px + x);
            covered += plane(texels.back(), drawn.layer_count()) > 0.f;
        }
    const std::size_t stride = std::max<std::size_t>(1, covered / most_sampled);
    std::vector<std::size_t> some;
    for (std::size_t i = 0; i < texels.size(); i += stride) some.push_back(texels[i]);
    return some;
}

// The form in C++ of sampled_texels.comp.glsl.
void copy_texels(PassContext& context, const SampledLayers& sampled) {
    const std::span<float> copies = context.memory<float>(sampled.texels);
    const TextureDesc &desc = sampled.texels.desc(), &map = sampled.drawn.map.desc();
    const BlockSample blocks = sampled.blocks();
    const std::size_t count = std::size_t(desc.width) * desc.height;
    const std::size_t map_count = std::size_t(map.width) * map.height;
    std::vector<std::span<const float>> sources{context.memory<float>(sampled.drawn.map)};
    if (sampled.drawn.moments) sources.push_back(context.memory<float>(*sampled.drawn.moments));
    std::span<const float> start, end;
    if (has_span(sampled.drawn)) {
        start = context.memory<float>(*sampled.drawn.span.start);
        end = context.memory<float>(*sampled.drawn.span.end);
    }
    const auto copy_texel = [&](std::size_t i) {
        const int x = blocks.unpacked(int(i) % desc.width);
        const int y = blocks.unpacked(int(i) / desc.width);
        if (x >= sampled.map_width_px || y >= sampled.map_height_px) return;
        const std::size_t place = sampled.drawn.place_of(x, y);
        std::size_t image = 0;
        for (const auto& source : sources)
            for (std::size_t layer = 0; layer < source.size() / map_count / 4; ++layer)
                std::copy_n(&source[(layer * map_count + place) * 4], 4,
                            &copies[(image++ * count + i) * 4]);
        if (start.empty()) return;
        const std::size_t texel = std::size_t(y) * sampled.map_width_px + x;
        copies[(image * count + i) * 4] = start[texel];
        copies[(image * count + i) * 4 + 1] = end[texel];
    };
    parallel_parts(count, std::size_t(desc.width), [&](std::size_t begin, std::size_t end_of_row) {
        for (std::size_t i = begin; i < end_of_row; ++i) copy_texel(i);
    });
}

}  // namespace

int fine_layer_count(int map_width_px) {
    return map_width_px <= 1024 ? 64 : map_width_px <= 2048 ? 32 : 16;
}

BlockSample searched_blocks(int map_width_px) {
    return {std::max(1, map_width_px / sampled_size_px)};
}

SampledLayers add_sampled_texels(FrameGraph& graph, const ShadowInputs& inputs,
                                 const DrawnLayers& drawn) {
    const int map_width_px = inputs.space.width_px(), map_height_px = inputs.space.height_px();
    const BlockSample blocks = searched_blocks(map_width_px);
    const TextureDesc desc{
        .format = Format::rgba32f,
        .width = blocks.packed_px(map_width_px),
        .height = blocks.packed_px(map_height_px),
        .layers = drawn.map.desc().layers + moment_images(drawn) + int(has_span(drawn))};
    const SampledLayers sampled{drawn, graph.texture("sampled_texels", desc), map_width_px,
                                map_height_px};
    Defines defines{{"LAYERS", "t_" + drawn.map.shader_name()},
                    {"BLOCK_PX", std::to_string(BlockSample::block_px)},
                    {"BLOCK_STRIDE", std::to_string(blocks.stride)}};
    Reads reads{&drawn.map};
    if (drawn.moments) {
        defines.emplace_back("MOMENTS", "t_" + drawn.moments->shader_name());
        reads.push_back(drawn.moments);
    }
    if (has_span(drawn)) {
        defines.emplace_back("HAS_SPAN", "1");
        reads.insert(reads.end(), {drawn.span.start, drawn.span.end});
    }
    graph.add({.name = "sampled_texels",
               .shader = {.compute = "sampled_texels.comp.glsl", .defines = std::move(defines)},
               .only_with = &inputs.translucent,
               .reads = std::move(reads),
               .stores = {&sampled.texels},
               .execute = [count = desc.width *
                                   desc.height](PassContext& context) { context.dispatch(count); },
               .on_cpu = [sampled](PassContext& context) { copy_texels(context, sampled); }});
    return sampled;
}

SampledTexels read_texels(PassContext& context, const SampledLayers& sampled) {
    const ReadBack back{context, sampled};
    SampledTexels some{sampled.drawn.planes.get(), {}, {}, {}};
    for (const std::size_t texel : back.chosen()) {
        for (int k = 1; k <= sampled.drawn.layer_count(); ++k) {
            some.values.push_back(back.plane(texel, k));
            if (sampled.drawn.moments) some.moments.push_back(back.moment(texel, k));
        }
        if (has_span(sampled.drawn)) some.depth_ranges.push_back(back.depth_range(texel));
    }
    return some;
}

}  // namespace opacity::techniques
