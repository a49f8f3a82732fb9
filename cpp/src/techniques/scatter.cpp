#include "techniques/scatter.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace opacity::techniques {
namespace {

// llvmpipe silently ends all loops of an invocation after 65,535 turns. A texel takes 24 rings of a
// particle, 11 halvings to a layer, and some layers of an interval.
constexpr double most_turns = 60000.0, turns_a_texel = 40.0;

constexpr double bits = 32.0;
constexpr double dark = 128.0;  // an optical depth: exp(-128) is 0 in float32
constexpr double least = 0x1p-40;

// A power of two; half of the range is left to what rounding adds.
float units_for(double most_optical_depth) {
    const double range = std::clamp(2.0 * most_optical_depth, least, dark);
    return float(std::exp2(std::floor(bits - std::log2(range))));
}

}  // namespace

Scatter::Scatter(FrameGraph& graph, const ShadowInputs& inputs, int layers)
    : inputs_{inputs},
      most_texels_{most_turns / (turns_a_texel + layers)},
      sizes_{graph.value("caster_sizes", std::vector<CasterSize>{})},
      fixed_point_{graph.value("fixed_point", 1.f)} {
    graph.add({.name = "measure_casters",
               .only_with = &inputs.translucent,
               .reads = {&inputs.translucent.opacity},
               .values = {&sizes_, &fixed_point_},
               .execute = [&casters = inputs.translucent, &sizes = sizes_,
                           &fixed_point = fixed_point_](PassContext& context) {
                   context.set(sizes, caster_sizes(casters));
                   context.set(fixed_point, units_for(most_optical_depth(casters)));
               }});
}

Shader Scatter::shader(const std::string& file, bool optical_depth, Defines defines) const {
    Shader shader = inputs_.caster_shader(file, optical_depth, std::move(defines));
    shader.compute = file;
    return shader;
}

Reads Scatter::reads(bool optical_depth, Reads more) const {
    more.push_back(&sizes_);
    if (optical_depth) more.push_back(&fixed_point_);
    return inputs_.caster_reads(optical_depth, std::move(more));
}

std::string Scatter::run(PassContext& context) const {
    const std::vector<ShapePtr>& shapes = inputs_.translucent.shapes();
    std::set<const Shape*> small;
    for (std::size_t i = 0; i < shapes.size(); ++i) {
        const auto lock = shapes[i]->lock();
        if (most_texels(sizes_.get()[i], *shapes[i], inputs_.space) <= most_texels_)
            small.insert(shapes[i].get());
    }
    const auto is_small = [&](const Shape& shape) { return small.contains(&shape); };
    if (!small.empty()) context.dispatch_shapes(is_small);
    if (small.size() < shapes.size())
        context.draw({}, [&](const Shape& shape) { return !is_small(shape); });
    return "scatter: " + std::to_string(small.size()) + " of " + std::to_string(shapes.size()) +
           " shapes without rasteriser";
}

}  // namespace opacity::techniques
