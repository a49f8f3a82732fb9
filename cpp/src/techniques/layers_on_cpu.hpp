// Opacity layers without OpenGL, for Pass::on_cpu and LookUp::on_cpu. GLSL: lib/layers.glsl.
#pragma once

#include <functional>
#include <memory>

#include "map/lookup.hpp"
#include "opacity/technique.hpp"
#include "techniques/drawn_layers.hpp"

namespace opacity::techniques {

using OnCpu = std::function<void(PassContext&)>;

// Fills a part of the layers; of one block of 4 x 4 texels in every `block_stride`, both ways.
OnCpu layers_on_cpu(const ShadowInputs& inputs, const DrawnLayers& drawn, const LayerPart& part,
                    int block_stride);

// Of a swept map: plane k follows plane k - 4, in whose place it comes; slice.frag.glsl.
std::function<void(PassContext&, int plane, const ShapeFilter&)> plane_on_cpu(
    const ShadowInputs& inputs, const DrawnLayers& drawn);

// The look-up in them, for LookUp::on_cpu.
std::function<std::unique_ptr<TexelMap>(PassContext&)> look_up_on_cpu(const DrawnLayers& drawn,
                                                                      Interpolation interpolation);

}  // namespace opacity::techniques
