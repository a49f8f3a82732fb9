#include "techniques/smoothing.hpp"

#include <algorithm>

#include "core/parallel.hpp"
#include "opacity/core/math.hpp"

namespace opacity::techniques {
namespace {

struct Square {
    int left, top, right, bottom;
};

// Calls body(texel, around) for each texel of an atlas of square faces.
template <class Body>
void for_each_texel(const LightSpace& space, int radius, Body body) {
    const int width = space.width_px(), side = space.map_size_px;
    parallel_for(std::size_t(space.height_px()), [&](std::size_t row) {
        const int y = int(row), top = y / side * side;
        for (int x = 0; x < width; ++x) {
            const int left = x / side * side;
            const Square around{std::max(x - radius, left), std::max(y - radius, top),
                                std::min(x + radius, left + side - 1),
                                std::min(y + radius, top + side - 1)};
            body(row * width + std::size_t(x), around);
        }
    });
}

template <class Add>
void for_each_in(const Square& square, int width, Add add) {
    for (int y = square.top; y <= square.bottom; ++y)
        for (int x = square.left; x <= square.right; ++x) add(std::size_t(y) * width + x);
}

void smooth_depth(const LightSpace& space, int radius, std::span<const float> from,
                  std::span<float> to) {
    for_each_texel(space, radius, [&](std::size_t texel, const Square& around) {
        float sum = 0.f, count = 0.f;
        for_each_in(around, space.width_px(), [&](std::size_t i) {
            if (from[i] < 1.f) sum += from[i], count += 1.f;  // it has a caster
        });
        to[texel] = count > 0.f ? sum / count : 1.f;
    });
}

void smooth_layers(const LightSpace& space, int radius, std::span<const float> from,
                   std::span<float> to) {
    const std::size_t layer = std::size_t(space.width_px()) * space.height_px() * planes_per_target;
    for (std::size_t first = 0; first < to.size(); first += layer)
        for_each_texel(space, radius, [&](std::size_t texel, const Square& around) {
            float4 sum{};
            float count = 0.f;
            for_each_in(around, space.width_px(), [&](std::size_t i) {
                for (int c = 0; c < planes_per_target; ++c)
                    sum[c] += from[first + i * planes_per_target + c];
                count += 1.f;
            });
            for (int c = 0; c < planes_per_target; ++c)
                to[first + texel * planes_per_target + c] = sum[c] / count;
        });
}

}  // namespace

Texture& add_smooth_depth(FrameGraph& graph, const ShadowInputs& inputs, Texture& start,
                          const Param<int>& texels) {
    Texture& smooth = graph.texture("smooth/start", inputs.map(Format::r32f));
    graph.add({.name = "smooth_depth",
               .shader = {.compute = "smooth.comp.glsl"},
               .only_with = &inputs.translucent,
               .reads = {&start, &texels, &inputs.light},
               .stores = {&smooth},
               .execute =
                   [&smooth](PassContext& context) {
                       context.dispatch(smooth.desc().width * smooth.desc().height);
                   },
               .on_cpu =
                   [&start, &smooth, &texels, space = inputs.space](PassContext& context) {
                       smooth_depth(space, texels.get(), context.memory<float>(start),
                                    context.memory<float>(smooth));
                   }});
    return smooth;
}

DrawnLayers add_smooth_layers(FrameGraph& graph, const ShadowInputs& inputs,
                              const DrawnLayers& drawn, const Param<int>& texels) {
    const int layers = drawn.map.desc().layers;
    const Format format = drawn.planes_an_image() == 1 ? Format::r32f : Format::rgba32f;
    Texture& smooth = graph.texture("smooth/opacity", inputs.map(format, layers));
    Shader shader{.compute = "smooth.comp.glsl",
                  .defines = {{"LAYERS", "1"}, drawn.image_define()}};
    if (drawn.is_packed) shader.defines.emplace_back("PACKED", "1");
    graph.add({.name = "smooth_layers",
               .shader = std::move(shader),
               .only_with = &inputs.translucent,
               .reads = {&drawn.map, drawn.span.start, &texels, &inputs.light},
               .stores = {&smooth},
               .execute =
                   [&smooth, layers](PassContext& context) {
                       context.dispatch(smooth.desc().width * smooth.desc().height * layers);
                   },
               .on_cpu =
                   [drawn, &smooth, &texels, space = inputs.space](PassContext& context) {
                       // The look-up takes the start from its own map, packed or not.
                       smooth_layers(space, texels.get(), context.memory<float>(drawn.map),
                                     context.memory<float>(smooth));
                   }});
    return {smooth,      drawn.planes,    drawn.span,           nullptr,
            drawn.kappa, drawn.is_packed, drawn.ignores_beyond, false};
}

}  // namespace opacity::techniques
