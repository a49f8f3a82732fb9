// A technique turns casters, seen from a light, into textures, and knows how to look transmittance
// up in them. docs/add_a_technique.md walks through a new one: three files and one line.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "opacity/core/param.hpp"
#include "opacity/core/view_splits.hpp"
#include "opacity/graph/frame_graph.hpp"
#include "opacity/look_up.hpp"
#include "opacity/scene/light_space.hpp"

namespace opacity {

class Scene;
// Of the maps without OpenGL (src/map).
class LightCasters;
struct FragmentSource;

// How shaders are told of a light's faces or splits (lib/light.glsl); of one map alone nothing.
Defines light_defines(const LightSpace& space);

// What the renderer hands to every technique.
struct ShadowInputs {
    const View& light;            // light space: lib/light.glsl
    DrawList& translucent;        // casters with an optical depth
    const Texture& opaque_depth;  // of the first opaque caster in each texel, 1 where none is
    bool has_opaque;
    bool paper_deposit;  // one-texel lines of full opacity, as in the papers
    const LightSpace& space;
    LightCasters& casters;  // for passes in C++

    // A shader and the reads for a pass that draws casters through lib/deposit.glsl. It leaves out
    // what lies behind opaque casters, if there are any; with `optical_depth` it also reads
    // opacities.
    Shader caster_shader(const std::string& fragment, bool optical_depth,
                         Defines defines = {}) const;
    Reads caster_reads(bool optical_depth, Reads more = {}) const;
    TextureDesc map(Format format, int layers = 0) const {
        return {.format = format,
                .width = space.width_px(),
                .height = space.height_px(),
                .layers = layers};
    }
    // What the same pass draws, for its form in C++ (map/fragments.hpp).
    FragmentSource fragments(PassContext& context, bool optical_depth) const;
};

class Technique : public ParamOwner {
   public:
    explicit Technique(std::string name) : ParamOwner{std::move(name), "pyopacity techniques"} {}

    virtual std::string_view summary() const = 0;  // one sentence
    virtual std::string_view paper() const = 0;    // authors and year
    // Adds its passes; returns what the look-up takes.
    virtual LookUp build(FrameGraph& graph, const ShadowInputs& inputs) = 0;

    // Whose maps serve a scene that this light sees, and why; nobody's: its own.
    struct Delegate {
        std::shared_ptr<Technique> technique;
        std::string why;
    };
    virtual Delegate delegate(const Scene&, const LightSpace&) { return {}; }

    // How it cuts the camera's view, each part of which gets a map of its own beside that of a
    // directional light; no other light's.
    virtual ViewSplits view_splits() const { return {}; }

    // What it searches for is searched again at the next frame.
    virtual void needs_recompute() {}

    // techniques/<name>.glsl holds all its stages, each in #ifdef PASS_<name>, and for the look-up
    // float shadow_transmittance(Receiver receiver).
    std::string shader_path() const { return "techniques/" + name() + ".glsl"; }

    // Which optical depth a fragment adds, and where a receiver looks it up: the same for all.
    Choice deposit_rule{*this,
                        "deposit_rule",
                        {"area", "paper"},
                        "What a strand leaves in a texel: its ribbon's exact area, or, as in the "
                        "papers, a line one texel wide."};
    AutoParam<double> bias{
        *this,
        "bias",
        {0.0, 1e9},
        "World units toward the light within which casters do not count; auto: the "
        "receiver's strand width, at least 1e-4 of the casters' radius."};
    Choice filter{*this,
                  "filter",
                  {"box", "none", "bartlett", "gaussian", "pcf"},
                  "Weights of the texels around a receiver; none: the nearest texel; pcf: 4 x 4 "
                  "points."};
    Param<double> filter_radius{*this,
                                "filter_radius",
                                0.5,
                                {0.0, 32.0},
                                "Texels from the middle of the filter to its edge; box at 0.5 is "
                                "bilinear."};
    AutoParam<double> filter_width{
        *this,
        "filter_width",
        {0.0, 1e9},
        "World units from edge to edge of the filter, the same for every map "
        "size, at most 64 texels; auto: twice filter_radius."};
    Choice filter_domain{*this,
                         "filter_domain",
                         {"transmittance", "density"},
                         "What is averaged: T, or optical depth as if casters filled the filter "
                         "evenly."};

   protected:
    // What build returns for a shader that includes lib/lookup.glsl: its own reads and those of
    // that file.
    LookUp look_up(const ShadowInputs& inputs, Reads reads,
                   std::function<std::unique_ptr<TexelMap>(PassContext&)> on_cpu = {}) const;
};

// The names in the registry, in its order.
std::vector<std::string> technique_names();
// ParameterError that suggests the nearest name where there is none of this one.
std::unique_ptr<Technique> make_technique(std::string_view name);

}  // namespace opacity
