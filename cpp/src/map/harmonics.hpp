// Cosine and sine of the multiples of an angle: each is the one before, turned once more (Jansen
// and Bavoil 2010, section 4.1). The angle is reduced first, since float32 rounds large ones. GLSL:
// lib/harmonics.glsl.
#pragma once

#include <cmath>
#include <cstddef>
#include <numbers>

namespace opacity {

inline constexpr float two_pi = 2.f * std::numbers::pi_v<float>;

struct Turn {
    float cosine = 1.f, sine = 0.f;
};

// 1 is all the way round.
inline Turn turn_of(float turns) {
    const float angle = two_pi * (turns - std::round(turns));
    return {std::cos(angle), std::sin(angle)};
}

inline Turn turned(const Turn& turn, const Turn& by) {
    return {turn.cosine * by.cosine - turn.sine * by.sine,
            turn.sine * by.cosine + turn.cosine * by.sine};
}

// One harmonic after the other over an interval: in its middle, and half of its width.
class HarmonicMeans {
   public:
    HarmonicMeans(float begin_turns, float end_turns)
        : half_turns_{0.5f * (end_turns - begin_turns)},
          middle_{turn_of(begin_turns + half_turns_)},
          width_{turn_of(half_turns_)} {}

    void turn_on() {
        at_ = turned(at_, middle_);
        wide_ = turned(wide_, width_);
    }
    const Turn& at() const { return at_; }
    // How much smaller a harmonic is on average over the interval than in its middle: sin(x) / x. A
    // point, which takes no turn, is not.
    float spread(std::size_t harmonic) const {
        const float angle = two_pi * half_turns_ * float(harmonic);
        return angle > 0.f ? wide_.sine / angle : 1.f;
    }

   private:
    float half_turns_;
    Turn middle_, width_;  // of the first harmonic
    Turn at_, wide_;       // of that so far
};

}  // namespace opacity
