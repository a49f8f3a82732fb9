// The score of every split curve in every texel, in the channels of an array; the one behind the last
// curve keeps the weight of them all, which is the texel's optical depth. C++:
// techniques/local_splits.cpp.
#include "lib/invocation.glsl"
#include "lib/split_score.glsl"

uniform sampler2DArray t_histogram;
uniform sampler2D t_start, t_end;
uniform float u_receiver_bias;  // light space
layout(rgba32f) writeonly uniform image2DArray i_split_scores;

void main() {
    ivec2 size = imageSize(i_split_scores).xy;
    int index = int(invocation_index());
    ivec2 texel = ivec2(index % size.x, index / size.x);
    if (texel.y >= size.y) return;
    float before = 0.0;
    for (int cell = 0; cell < CELLS; ++cell) {
        float sum = texelFetch(t_histogram, ivec3(texel, cell / PLANES_AN_IMAGE), 0)[cell % PLANES_AN_IMAGE];
        cell_held[cell] = sum - before;
        before = sum;
    }
    float range = texelFetch(t_end, texel, 0).x - texelFetch(t_start, texel, 0).x;
    cell_bias = range > u_receiver_bias ? u_receiver_bias / range : 1.0;
    if (before > 0.0) find_transmittance();
    for (int group = 0; group <= CURVES / 4; ++group) {
        vec4 scores = vec4(0.0);
        for (int i = 0; i < 4 && before > 0.0; ++i) {
            int curve = 4 * group + i;
            scores[i] = curve < CURVES ? score(curve) : curve == CURVES ? before : 0.0;
        }
        imageStore(i_split_scores, ivec3(texel, group), scores);
    }
}
