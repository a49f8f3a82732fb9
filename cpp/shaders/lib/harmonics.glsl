// Cosine and sine of the multiples of an angle: each is the one before, turned once more (Jansen and
// Bavoil 2010, section 4.1). The angle is reduced first, since float32 rounds large ones, and GPUs
// promise the sine of small ones only. C++: map/harmonics.hpp.

const float two_pi = 6.2831853;

// 1 is all the way round.
vec2 turn_of(float turns) {
    float angle = two_pi * (turns - round(turns));
    return vec2(cos(angle), sin(angle));
}

vec2 turned(vec2 turn, vec2 by) {
    return vec2(turn.x * by.x - turn.y * by.y, turn.y * by.x + turn.x * by.y);
}

// How much smaller a harmonic is on average over an interval than in its middle: sin(x) / x. A point,
// which takes no turn, is not.
float spread(float sine, float angle) { return angle > 0.0 ? sine / angle : 1.0; }
