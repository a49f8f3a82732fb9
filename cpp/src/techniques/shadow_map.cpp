#include "techniques/shadow_map.hpp"

#include <algorithm>
#include <cstddef>
#include <memory>
#include <span>

#include "map/fragments.hpp"
#include "map/lookup.hpp"

namespace opacity::techniques {
namespace {

// As in shadow_map.glsl.
constexpr float opaque_optical_depth = 200.f, own_margin = 1e-5f;

void draw_on_cpu(PassContext& context, const ShadowInputs& inputs, const Texture& half_depth) {
    const std::span<float> map = context.memory<float>(half_depth);
    for_each_fragment(inputs.fragments(context, true), [&](const Fragment& fragment) {
        if (fragment.optical_depth > 0.f)
            map[fragment.texel] = std::min(map[fragment.texel], 0.5f * fragment.depth);
    });
}

class FirstDepths : public TexelMap {
   public:
    explicit FirstDepths(std::span<const float> half_depth) : half_depth_{half_depth} {}

    float optical_depth(std::size_t texel, float depth, const OwnDeposit& own) const override {
        if (own.optical_depth > 0.f) depth = std::min(depth, own.depth - own_margin);
        return half_depth_[texel] < std::min(0.5f * depth, 1.f) ? opaque_optical_depth : 0.f;
    }

   private:
    std::span<const float> half_depth_;
};

}  // namespace

LookUp ShadowMap::build(FrameGraph& graph, const ShadowInputs& inputs) {
    Texture& half_depth = graph.texture("half_depth", inputs.map(Format::depth32f));
    graph.add({.name = "half_depth",
               .shader = inputs.caster_shader(shader_path(), true, {{"PASS_half_depth", "1"}}),
               .draws = &inputs.translucent,
               .view = &inputs.light,
               .reads = inputs.caster_reads(true),
               .writes = {&half_depth},
               .state = {.depth = Depth::less, .clear_depth = 1.f},
               .on_cpu = [inputs, &half_depth](PassContext& context) {
                   draw_on_cpu(context, inputs, half_depth);
               }});
    return look_up(inputs, {&half_depth}, [&half_depth](PassContext& context) {
        return std::make_unique<FirstDepths>(context.memory<float>(half_depth));
    });
}

}  // namespace opacity::techniques
