#include "techniques/bounded_layers.hpp"

#include <algorithm>

#include "opacity/scene/mesh.hpp"

namespace opacity::techniques {

// Coarser sums do not tell where in a layer what it holds lies. A leaf is one caster, and often the
// only one of its layer; strands and media are many.
Interpolation BoundedLayers::between_planes(const ShadowInputs& inputs) const {
    const bool is_fine = accumulator_bits() == 32 && !inputs.paper_deposit;
    if (interpolation.is("linear") || (interpolation.is("auto") && !is_fine))
        return Interpolation::linear;
    const auto is_surface = [](const ShapePtr& shape) {
        return dynamic_cast<const Mesh*>(shape.get()) != nullptr;
    };
    return std::ranges::any_of(inputs.translucent.shapes(), is_surface)
               ? Interpolation::mean_depth_of_few
               : Interpolation::mean_depth;
}

}  // namespace opacity::techniques
