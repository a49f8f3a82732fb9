// Casters by scatter: each adds what it deposits to its own place, by atomics, in one pass over the
// casters; on strands and particles an invocation a caster looks at the texels that this one
// covers, without a rasteriser. Meshes, volumes and what is large in the map are drawn, and
// scattered by the fragment stage. GLSL: lib/scatter.glsl.
#pragma once

#include <string>
#include <vector>

#include "opacity/technique.hpp"
#include "techniques/caster_sizes.hpp"

namespace opacity::techniques {

class Scatter {
   public:
    // Declares the pass that measures the casters. No invocation goes through more than so many
    // layers for a texel.
    Scatter(FrameGraph& graph, const ShadowInputs& inputs, int layers);

    // A shader of all three stages, in one file; and the pass's reads.
    Shader shader(const std::string& file, bool optical_depth, Defines defines = {}) const;
    Reads reads(bool optical_depth, Reads more = {}) const;
    // Visits every caster, by whichever stage; returns what the report says of it.
    std::string run(PassContext& context) const;

    // Units in an optical depth of 1, so that the sum of a layer fits into 32 bits: of all casters
    // at once, or of 128, behind which T is 0.
    const Value<float>& fixed_point() const { return fixed_point_; }
    const ShadowInputs& inputs() const { return inputs_; }

   private:
    using Sizes = Value<std::vector<CasterSize>>;

    ShadowInputs inputs_;
    double most_texels_;
    Sizes& sizes_;
    Value<float>& fixed_point_;
};

}  // namespace opacity::techniques
