// How well layers between the planes of a split curve serve one texel, by a fine histogram of it: each
// of its CELLS is a caster in the middle, that of the first lies at 0 and that of the last at 1. C++:
// map/split_score.hpp.
#include "lib/layer_held.glsl"
#include "lib/planes.glsl"

uniform float u_cells[CELLS + 1];  // the planes of the histogram

float cell_held[CELLS];           // optical depth
float cell_transmittance[CELLS];  // in front of a receiver on its caster
float cell_bias;                  // within which it does not count casters, as a part of the texel's range

float place_of(int cell) {
    return cell == 0 ? 0.0 : cell == CELLS - 1 ? 1.0 : 0.5 * (u_cells[cell] + u_cells[cell + 1]);
}

// Once cell_held and cell_bias are known.
void find_transmittance() {
    float in_front = 0.0;
    int caster = 0;
    for (int receiver = 0; receiver < CELLS; ++receiver) {
        float x = place_of(receiver) - cell_bias;
        for (; caster < CELLS && place_of(caster) < x; ++caster) in_front += cell_held[caster];
        cell_transmittance[receiver] = exp(-in_front);
    }
}

float optical_depth_of_texel() {
    float sum = 0.0;
    for (int cell = 0; cell < CELLS; ++cell) sum += cell_held[cell];
    return sum;
}

// Where layer k ends; the last one is closed.
float layer_end(int curve, int k) { return k + 1 < u_layers ? plane(curve, k + 1) : 2.0; }

// What layer k holds, of the casters from `caster` on, which moves behind it: optical depth, and the
// same times position.
vec2 held_by(int curve, int k, inout int caster) {
    vec2 held = vec2(0.0);
    for (; caster < CELLS && place_of(caster) < layer_end(curve, k); ++caster)
        held += cell_held[caster] * vec2(1.0, place_of(caster));
    return held;
}

#if defined(SIMILARITY_error)
// What a look-up makes of a layer, where the receiver's own caster is left out.
float looked_up(int curve, int k, vec2 held, float x) {
    float low = plane(curve, k), high = plane(curve, k + 1);
#ifdef MEAN_DEPTHS
    return held_in_front(held, low, high, x);
#else
    return held.x * clamp((x - low) / (high - low), 0.0, 1.0);
#endif
}

// The sum over the casters, by their optical depth, of the square error of T on them.
float score(int curve) {
    float sum = 0.0, before = 0.0;
    int caster = 0, receiver = 0;
    for (int k = 0; k < u_layers; ++k) {
        int first = caster;
        vec2 held = held_by(curve, k, caster);
        for (; receiver < CELLS && place_of(receiver) - cell_bias < layer_end(curve, k); ++receiver) {
            if (!(cell_held[receiver] > 0.0)) continue;
            vec2 others = held;
#ifdef OWN_CORRECTION
            if (receiver >= first && receiver < caster)
                others -= cell_held[receiver] * vec2(1.0, place_of(receiver));
#endif
            float found = before + looked_up(curve, k, others, place_of(receiver) - cell_bias);
            float error = exp(-found) - cell_transmittance[receiver];
            sum += cell_held[receiver] * error * error;
        }
        before += held.x;
    }
    return sum;
}
#else
// What two neighbouring opacity images differ by in this texel.
float difference(float nearer, float farther) {
#ifdef SIMILARITY_paper_absolute_difference
    return (floor(255.0 * min(farther, 1.0) + 0.5) - floor(255.0 * min(nearer, 1.0) + 0.5)) / 255.0;
#else
    return opacity_of(farther) - opacity_of(nearer);
#endif
}

// By the optical depth of all: what the smallest difference lacks of 1, or in the paper's form, which
// compares the K layers and not the empty one before them, the sum.
float score(int curve) {
    float smallest = 1.0, sum = 0.0, before = 0.0;
    int caster = 0;
    for (int k = 0; k < u_layers; ++k) {
        float behind = before + held_by(curve, k, caster).x;
        smallest = min(smallest, difference(before, behind));
        if (k > 0) sum += difference(before, behind);
        before = behind;
    }
#ifdef SIMILARITY_paper_absolute_difference
    return before * (1.0 - sum);
#else
    return before * (1.0 - smallest);
#endif
}
#endif
