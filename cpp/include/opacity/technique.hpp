// A technique turns casters, seen from a light, into textures, and knows how to look transmittance
// up in them. docs/add_a_technique.md walks through a new one: three files and one line.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "opacity/core/param.hpp"
#include "opacity/graph/frame_graph.hpp"

namespace opacity {

// What the renderer hands to every technique.
struct ShadowInputs {
    const View& light;            // light space: lib/light.glsl
    DrawList& translucent;        // casters with an optical depth
    const Texture& opaque_depth;  // first opaque caster in each texel, 1 where there is none
    bool has_opaque;
    int map_size_px;

    // A shader and the reads for a pass that draws casters through lib/deposit.glsl. It leaves out
    // what lies behind opaque casters, if there are any; with `optical_depth` it also reads
    // opacities.
    Shader caster_shader(const std::string& fragment, bool optical_depth,
                         Defines defines = {}) const;
    Reads caster_reads(bool optical_depth, Reads more = {}) const;
    TextureDesc map(Format format, int layers = 0) const {
        return {.format = format, .width = map_size_px, .height = map_size_px, .layers = layers};
    }
};

class Technique : public ParamOwner {
   public:
    explicit Technique(std::string name) : ParamOwner{std::move(name), "pyopacity techniques"} {}

    virtual std::string_view summary() const = 0;  // one sentence
    virtual std::string_view paper() const = 0;    // authors and year
    // Adds its passes; returns what the look-up must read.
    virtual Reads build(FrameGraph& graph, const ShadowInputs& inputs) = 0;

    // What it searches for is searched again at the next frame.
    virtual void needs_recompute() {}

    // techniques/<name>.glsl holds all its stages, each in #ifdef PASS_<name>, and for the look-up
    // float shadow_transmittance(vec3 p_ls).
    std::string shader_path() const { return "techniques/" + name() + ".glsl"; }

    AutoParam bias{*this,
                   "bias",
                   {0.0, 1e9},
                   "World units toward the light within which casters do not count; auto: the "
                   "receiver's strand width, at least 1e-4 of the casters' radius."};

   protected:
    // What build returns for a shader that includes lib/lookup.glsl: its own reads and those of
    // that file.
    Reads look_up(const ShadowInputs& inputs, Reads reads) const;
};

// The names in the registry, in its order.
std::vector<std::string> technique_names();
// ParameterError that suggests the nearest name where there is none of this one.
std::unique_ptr<Technique> make_technique(std::string_view name);

}  // namespace opacity
