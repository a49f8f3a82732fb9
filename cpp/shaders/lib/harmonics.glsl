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

// One harmonic after the other over an interval: in its middle, and half of its width.
struct Means {
    vec2 at, wide;       // of the harmonic so far
    vec2 middle, width;  // of the first
    float half_turns;
};

Means harmonics_over(float begin_turns, float end_turns) {
    float half_turns = 0.5 * (end_turns - begin_turns);
    vec2 middle = turn_of(begin_turns + half_turns), width = turn_of(half_turns);
    return Means(vec2(1.0, 0.0), vec2(1.0, 0.0), middle, width, half_turns);
}

void turn_on(inout Means means) {
    means.at = turned(means.at, means.middle);
    means.wide = turned(means.wide, means.width);
}

// How much smaller a harmonic is on average over the interval than in its middle: sin(x) / x. A point,
// which takes no turn, is not.
float spread_of(Means means, int harmonic) {
    float angle = two_pi * means.half_turns * float(harmonic);
    return angle > 0.0 ? means.wide.y / angle : 1.0;
}
