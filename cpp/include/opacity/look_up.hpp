// What a technique tells of its maps to whoever asks them for T.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "opacity/graph/frame_graph.hpp"

namespace opacity {

class TexelMap;  // a map without OpenGL (src/map)

// A look-up that holds four planes at a time, as lib/layer_map.glsl has it: each adds to the one
// four before it the casters in between, and receivers between two planes are asked while these are
// there.
struct Sweep {
    static constexpr int planes_held = 4;
    Shader shader = {};         // draws u_plane; the look-up has its defines, too
    DrawList* draws = nullptr;  // some casters
    Reads reads = {};
    Texture* map = nullptr;
    const Value<std::vector<float>>* planes = nullptr;  // depths
    int planes_ahead = 1;  // that a look-up in front of plane k reads, from k on
    std::function<void(PassContext&, int plane, const ShapeFilter&)> draw_on_cpu = {};
    std::function<std::unique_ptr<TexelMap>(PassContext&)> on_cpu = {};
};

// What a shader that asks for T takes besides the light.
struct LookUp {
    Reads reads = {};
    Defines defines = {};
    bool own_correction = false;  // it also wants to know what the receiver itself casts
    // The look-up's form in C++, over the declared reads.
    std::function<std::unique_ptr<TexelMap>(PassContext&)> on_cpu = {};
    // Where it can answer about points without what `reads` hold.
    std::optional<Sweep> sweep = {};
};

}  // namespace opacity
