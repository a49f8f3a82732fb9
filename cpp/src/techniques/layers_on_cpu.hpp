// Opacity layers between two depths of each texel, without OpenGL: what a technique's GLSL says
// with lib/planes.glsl, for Pass::on_cpu and LookUp::on_cpu.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "map/lookup.hpp"
#include "opacity/technique.hpp"

namespace opacity::techniques {

constexpr int planes_per_target = 4;

using OnCpu = std::function<void(PassContext&)>;

// Where the first caster of each texel begins, and where the last one ends.
OnCpu first_depth_on_cpu(const ShadowInputs& inputs, Texture& depth);
OnCpu last_depth_on_cpu(const ShadowInputs& inputs, Texture& depth);

// Cumulative optical depth at planes between start and end: plane 4 t + c + 1 is channel c of layer
// t of `map`.
struct LayersInMap {
    Texture &start, &end, &map;
    Value<std::vector<float>>& planes;
};

// Fills `target_count` layers of the map from `first_target` on; of one block of 4 x 4 texels in
// every `block_stride`, both ways.
OnCpu layers_on_cpu(const ShadowInputs& inputs, const LayersInMap& layers, int first_target,
                    int target_count, int block_stride);

std::function<std::unique_ptr<TexelMap>(PassContext&)> layers_look_up(const LayersInMap& layers);

}  // namespace opacity::techniques
