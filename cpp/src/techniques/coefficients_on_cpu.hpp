// Coefficient maps without OpenGL, for Pass::on_cpu and LookUp::on_cpu. GLSL:
// lib/coefficients.glsl.
#pragma once

#include <functional>
#include <memory>

#include "map/lookup.hpp"
#include "techniques/coefficient_maps.hpp"

namespace opacity::techniques {

// Fills `target_count` layers of the map from `first_target` on.
std::function<void(PassContext&)> coefficients_on_cpu(const ShadowInputs& inputs,
                                                      const Coefficients& coefficients,
                                                      int first_target, int target_count);
// The look-up in them, for LookUp::on_cpu.
std::function<std::unique_ptr<TexelMap>(PassContext&)> look_up_on_cpu(
    const Coefficients& coefficients);

}  // namespace opacity::techniques
