// A pass is data: what it is called, which shader runs, what it reads and writes, and in which
// state.
#pragma once

#include <compare>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "opacity/graph/draw_list.hpp"
#include "opacity/graph/resource.hpp"
#include "opacity/graph/view.hpp"

namespace opacity {

class PassContext;

using Defines = std::vector<std::pair<std::string, std::string>>;

// Files under shaders/: a vertex and a fragment stage, a compute stage, or all three for a pass
// that draws some shapes and dispatches others. Every stage sees its defines, such as PASS_opacity
// for one of several stages in a file, and while shapes are drawn their kind: STRANDS, MESH (with
// ALPHA_MAP where it has one), PARTICLES or VOLUME; #include "technique.glsl" means `technique`.
struct Shader {
    std::string vertex = {}, fragment = {}, compute = {};
    std::string technique = {};
    Defines defines = {};
    // A second technique in the same shader: #include "camera/technique.glsl" means this one, all
    // of whose names start with camera_, or u_camera_, t_camera_; its defines are given without
    // that.
    std::string camera_technique = {};
    Defines camera_defines = {};
    auto operator<=>(const Shader&) const = default;
};

using Reads = std::vector<const Source*>;

// One image of a texture: layer 0 of a plain one.
struct Target {
    Texture* texture = nullptr;
    int layer = 0;
    std::optional<float4> clear_color = {};  // none: that of the pass's state
    // NOLINTNEXTLINE: {&texture} reads as a target
    Target(Texture* t, int l = 0, std::optional<float4> clear = {})
        : texture{t}, layer{l}, clear_color{clear} {}
    bool operator==(const Target&) const = default;
};

enum class Depth { off, less, greater };
// over: premultiplied colours, the farthest first; bounds: the least in the first target, and the
// largest in the others.
enum class Blend { off, add, over, bounds };

// Which primitives of each shape are drawn, in which order: as they are stored; the farthest from
// the view first; or of a strand (else primitive) number modulo `parts` only those that are `part`.
struct Selection {
    bool back_to_front = false;
    int part = 0, parts = 1;
    bool operator==(const Selection&) const = default;
};

// Complete: nothing is inherited from the pass before.
struct State {
    Depth depth = Depth::off;
    Blend blend = Blend::off;
    float clear_depth = 1.f;
    float4 clear_color = {0.f, 0.f, 0.f, 0.f};
    Selection selection = {};
    bool largest_alpha = false;      // of the first target the largest alpha remains, not the sum
    bool swaps_depth_range = false;  // gl_DepthRange is from 1 to 0
    bool operator==(const State&) const = default;
};

struct Pass {
    std::string name;                    // "opacity": shown as "bounding_opacity_maps/opacity"
    Shader shader = {};                  // none: the pass computes on the CPU
    DrawList* draws = nullptr;           // shapes to draw; an empty list culls the pass
    const View* view = nullptr;          // from where it draws them
    bool draws_unseen = false;           // also chunks and strands that the view does not see
    DrawList* only_with = nullptr;       // draws nothing, and is culled while this list is empty
    Reads reads = {};                    // textures, values, parameters, views, parts of shapes
    Reads camera_reads = {};             // those of Shader::camera_technique, for its names
    std::vector<Target> writes = {};     // colour targets in MRT order; a depth texture anywhere
    const Texture* tests = nullptr;      // depths that fragments are tested against, and that stay
    std::vector<Resource*> stores = {};  // images i_<name> and buffers b_<name> for the shader
    std::vector<Source*> values = {};    // CPU results such as the split ratio
    State state = {};
    // Default: draw the shapes. A lambda captures `this` and graph-owned resources only.
    std::function<void(PassContext&)> execute = {};
    // What a shader does, in C++: for the device without OpenGL.
    std::function<void(PassContext&)> on_cpu = {};
};

// Everything that moves a pass: what it declares to read, from where it draws, and which shapes.
Reads all_reads(const Pass& pass);

}  // namespace opacity
