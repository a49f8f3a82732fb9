// A technique that spreads each caster over a part of the depths, so that a look-up counts some of
// what the receiver itself casts, unless that is taken out.
#pragma once

#include <string>
#include <utility>

#include "opacity/technique.hpp"

namespace opacity::techniques {

class OwnCorrected : public Technique {
   public:
    Param<bool> own_correction{*this, "own_correction", true,
                               "Takes out of a look-up what it counts of the receiver's own "
                               "deposit; not with deposit_rule paper."};

   protected:
    explicit OwnCorrected(std::string name) : Technique{std::move(name)} {}

    bool corrects(const ShadowInputs& inputs) const {
        return own_correction.get() && !inputs.paper_deposit;
    }
};

}  // namespace opacity::techniques
