// Between which depths of light space the layers of each texel lie, without OpenGL. GLSL:
// lib/layer_span.glsl.
#pragma once

#include <cstddef>
#include <span>

#include "map/planes.hpp"
#include "opacity/graph/pass_context.hpp"
#include "techniques/drawn_layers.hpp"

namespace opacity::techniques {

class TexelSpans {
   public:
    TexelSpans(PassContext& context, const LayerSpan& span) {
        if (span.start) start_ = context.memory<float>(*span.start);
        if (span.end) end_ = context.memory<float>(*span.end);
        if (span.depth) depth_ = span.depth->get();
    }

    bool ends_at_last_caster() const { return !end_.empty(); }
    float start(std::size_t texel) const { return start_.empty() ? 0.f : start_[texel]; }
    float end(std::size_t texel) const {
        return end_.empty() ? start(texel) + depth_ : end_[texel];
    }
    float position(std::size_t texel, float depth) const {
        return between(start(texel), end(texel), depth);
    }

   private:
    std::span<const float> start_, end_;
    float depth_ = 1.f;
};

}  // namespace opacity::techniques
