// Layers between the first and the last caster of each texel, of which a map may also keep the mean
// depth of what each holds (docs/accuracy.md, "The look-up").
#pragma once

#include <string>
#include <utility>

#include "techniques/layered.hpp"

namespace opacity::techniques {

class BoundedLayers : public Layered {
   public:
    Choice interpolation{*this,
                         "interpolation",
                         {"auto", "linear", "mean_depth"},
                         "Between planes: linear lets optical depth grow evenly, as in the thesis; "
                         "mean_depth keeps the mean depth of what each layer holds, and T falls "
                         "about it; auto does so with the accumulator float32 and our deposit "
                         "rule."};

   protected:
    explicit BoundedLayers(std::string name)
        : Layered{std::move(name), 64, "Opacity layers between the two bounds."} {}

    Interpolation between_planes(const ShadowInputs& inputs) const;
};

}  // namespace opacity::techniques
