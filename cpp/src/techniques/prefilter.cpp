#include "techniques/prefilter.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "core/parallel.hpp"
#include "map/filter.hpp"
#include "opacity/core/math.hpp"

namespace opacity::techniques {
namespace {

using Place = std::array<int, 2>;

// Texels along a face at a level of a mip chain; 0 is the map.
int side_at(const LightSpace& space, int level) {
    return (space.map_size_px + (1 << level) - 1) >> level;
}

TextureDesc desc_at(const ShadowInputs& inputs, const Texture& map, int level) {
    const int side = side_at(inputs.space, level), columns = inputs.space.columns();
    TextureDesc desc = inputs.map(Format::rgba32f, map.desc().layers);
    desc.width = columns * side;
    desc.height = inputs.space.height_px() / inputs.space.map_size_px * side;
    return desc;
}

// Texels of one level's map, on the CPU.
class LevelTexels {
   public:
    LevelTexels(std::span<float> values, const TextureDesc& desc, int side)
        : side{side}, values_{values}, desc_{desc} {}
    const int side;

    std::span<float, 4> at(int layer, const Place& face, const Place& place) const {
        const int x = face[0] * side + place[0], y = face[1] * side + place[1];
        const auto row = std::size_t(layer) * desc_.height + std::size_t(y);
        return values_.subspan(4 * (row * desc_.width + std::size_t(x))).first<4>();
    }
    // Calls filtered(layer, face, place) for each texel, and keeps what it returns.
    template <class Filtered>
    void fill(Filtered filtered) const {
        parallel_for(std::size_t(desc_.layers) * desc_.height, [&](std::size_t row) {
            const int layer = int(row) / desc_.height, y = int(row) % desc_.height;
            for (int x = 0; x < desc_.width; ++x) {
                const Place face{x / side, y / side}, place{x % side, y % side};
                std::ranges::copy(filtered(layer, face, place), at(layer, face, place).begin());
            }
        });
    }

   private:
    std::span<float> values_;
    const TextureDesc desc_;
};

struct Mean {
    float4 sum{};
    float weight = 0.f;

    void add(std::span<const float, 4> value, float w) {
        for (std::size_t i = 0; i < 4; ++i) sum[i] += w * value[i];
        weight += w;
    }
    float4 get() const {
        float4 mean = sum;
        for (float& value : mean) value /= weight;
        return mean;
    }
};

// The steps, as in prefilter.comp.glsl.

void weigh(const LevelTexels& from, const LevelTexels& to, std::size_t axis,
           std::span<const float> weights) {
    const int reach = int(weights.size()) - 1;
    to.fill([&](int layer, const Place& face, const Place& place) {
        Mean mean;
        for (int i = -reach; i <= reach; ++i) {
            Place there = place;
            there[axis] += i;
            if (there[axis] < 0 || there[axis] >= from.side) continue;
            mean.add(from.at(layer, face, there), weights[std::size_t(std::abs(i))]);
        }
        return mean.get();
    });
}

void halve(const LevelTexels& from, const LevelTexels& to, int level, int map_size_px) {
    const auto length_of = [&](int i) {  // texels of the map
        return std::min((i + 1) << (level - 1), map_size_px) - (i << (level - 1));
    };
    to.fill([&](int layer, const Place& face, const Place& place) {
        Mean mean;
        for (int i = 0; i < 4; ++i) {
            const Place there{2 * place[0] + i % 2, 2 * place[1] + i / 2};
            if (there[0] >= from.side || there[1] >= from.side) continue;
            mean.add(from.at(layer, face, there), float(length_of(there[0]) * length_of(there[1])));
        }
        return mean.get();
    });
}

void spread(const LevelTexels& from, const LevelTexels& to, int level) {
    to.fill([&](int layer, const Place& face, const Place& place) {
        Place below;
        std::array<float, 2> part;
        for (std::size_t axis = 0; axis < 2; ++axis) {
            const float p = (float(place[axis]) + 0.5f) / float(1 << level) - 0.5f;
            below[axis] = int(std::floor(p));
            part[axis] = p - float(below[axis]);
        }
        Mean mean;
        for (int i = 0; i < 4; ++i) {
            const Place there{std::clamp(below[0] + i % 2, 0, from.side - 1),
                              std::clamp(below[1] + i / 2, 0, from.side - 1)};
            mean.add(from.at(layer, face, there),
                     (i % 2 ? part[0] : 1.f - part[0]) * (i / 2 ? part[1] : 1.f - part[1]));
        }
        return mean.sum;
    });
}

// From a level of a map to a level of another.
struct Step {
    std::string name;
    Texture& from;
    int from_level;
    Texture& to;
    int to_level;
    Defines defines;
    Reads reads = {};
};

template <class OnCpu>
void add_step(FrameGraph& graph, const ShadowInputs& inputs, Step step, OnCpu on_cpu) {
    Texture &from = step.from, &to = step.to;
    step.reads.insert(step.reads.end(), {&from, &inputs.light});
    for (auto& define : light_defines(inputs.space)) step.defines.push_back(std::move(define));
    graph.add({.name = std::move(step.name),
               .shader = {.compute = "prefilter.comp.glsl", .defines = std::move(step.defines)},
               .only_with = &inputs.translucent,
               .reads = std::move(step.reads),
               .stores = {&to},
               .execute =
                   [&to](PassContext& context) {
                       const TextureDesc& desc = to.desc();
                       context.dispatch(desc.width * desc.height * desc.layers);
                   },
               .on_cpu =
                   [&from, &to, on_cpu, before = side_at(inputs.space, step.from_level),
                    after = side_at(inputs.space, step.to_level)](PassContext& context) {
                       on_cpu(LevelTexels{context.memory<float>(from), from.desc(), before},
                              LevelTexels{context.memory<float>(to), to.desc(), after});
                   }});
}

// Of the texel itself, and of those to one side.
std::vector<float> kernel_weights(FilterKernel kernel, int texels) {
    std::vector<float> weights;
    for (int i = 0; i <= texels; ++i)
        weights.push_back(filter_weight(kernel, float(i) - 0.5f, float(texels) + 0.5f));
    return weights;
}

Texture& add_kernel(FrameGraph& graph, const ShadowInputs& inputs, Texture& map,
                    FilterKernel kernel, int texels) {
    auto& reach = graph.value("reach", 0);
    auto& weights = graph.value("weights", std::vector<float>{});
    reach.set(texels);
    weights.set(kernel_weights(kernel, texels));
    Texture* from = &map;
    for (const std::size_t axis : {std::size_t{0}, std::size_t{1}}) {
        const std::string name = axis == 0 ? "rows" : "columns";
        const FrameGraph::Scope scope{graph, name};
        Texture& to = graph.texture(map.shader_name(), desc_at(inputs, map, 0));
        add_step(graph, inputs,
                 {.name = "mean",
                  .from = *from,
                  .from_level = 0,
                  .to = to,
                  .to_level = 0,
                  .defines = {{"WEIGHTS", std::to_string(most_prefilter_texels + 1)},
                              {"AXIS", std::to_string(axis)}},
                  .reads = {&reach, &weights}},
                 [&weights, axis](const LevelTexels& before, const LevelTexels& after) {
                     weigh(before, after, axis, weights.get());
                 });
        from = &to;
    }
    return *from;
}

Texture& add_mip_chain(FrameGraph& graph, const ShadowInputs& inputs, Texture& map, int texels) {
    const int last = std::min(int(std::lround(std::log2(2.0 * texels + 1.0))),
                              int(std::ceil(std::log2(double(inputs.space.map_size_px)))));
    Texture* from = &map;
    for (int level = 1; level <= last; ++level) {
        const FrameGraph::Scope scope{graph, "level" + std::to_string(level)};
        Texture& to = graph.texture(map.shader_name(), desc_at(inputs, map, level));
        add_step(graph, inputs,
                 {.name = "halves",
                  .from = *from,
                  .from_level = level - 1,
                  .to = to,
                  .to_level = level,
                  .defines = {{"HALVES", std::to_string(level)}}},
                 [level, size_px = inputs.space.map_size_px](const LevelTexels& before,
                                                             const LevelTexels& after) {
                     halve(before, after, level, size_px);
                 });
        from = &to;
    }
    Texture& to = graph.texture(map.shader_name(), desc_at(inputs, map, 0));
    add_step(graph, inputs,
             {.name = "spread",
              .from = *from,
              .from_level = last,
              .to = to,
              .to_level = 0,
              .defines = {{"SPREAD", std::to_string(last)}}},
             [last](const LevelTexels& before, const LevelTexels& after) {
                 spread(before, after, last);
             });
    return to;
}

}  // namespace

Texture& add_prefilter(FrameGraph& graph, const ShadowInputs& inputs, Texture& map,
                       Prefilter prefilter, int texels) {
    if (prefilter == Prefilter::none) return map;
    const FrameGraph::Scope scope{graph, "prefilter"};
    if (prefilter == Prefilter::mip_chain) return add_mip_chain(graph, inputs, map, texels);
    const bool is_box = prefilter == Prefilter::box;
    return add_kernel(graph, inputs, map, is_box ? FilterKernel::box : FilterKernel::gaussian,
                      texels);
}

}  // namespace opacity::techniques
