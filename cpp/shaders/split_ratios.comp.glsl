// The split ratio of every square of REGION_PX texels: that of the first curve with a score no worse
// than the best, also by the texels that touch the square, since their receivers look in it, too. C++:
// techniques/local_splits.cpp.
#include "lib/invocation.glsl"

uniform sampler2DArray t_split_scores;
layout(r32f) writeonly uniform image2D i_split_ratios;

// Roots of mean scores; errors of T that no one sees are equal.
const float equal_scores = 1e-4;
// A texel counts as much as the eight around it.
const float own_weight = 8.0;

void main() {
    ivec2 size = imageSize(i_split_ratios);
    int index = int(invocation_index());
    ivec2 region = ivec2(index % size.x, index / size.x);
    if (region.y >= size.y) return;
    vec4 sums[CURVES / 4 + 1];
    for (int group = 0; group <= CURVES / 4; ++group) sums[group] = vec4(0.0);
    ivec2 first = region * REGION_PX, last = first + REGION_PX - 1;
    ivec2 end = textureSize(t_split_scores, 0).xy - 1;
    for (int y = max(first.y - 1, 0); y <= min(last.y + 1, end.y); ++y)
        for (int x = max(first.x - 1, 0); x <= min(last.x + 1, end.x); ++x) {
            ivec2 texel = ivec2(x, y);
            bool is_own = all(greaterThanEqual(texel, first)) && all(lessThanEqual(texel, last));
            for (int group = 0; group <= CURVES / 4; ++group)
                sums[group] += (is_own ? own_weight : 1.0) * texelFetch(t_split_scores, ivec3(texel, group), 0);
        }
    float weight = sums[CURVES / 4][CURVES % 4], least = weight;
    for (int curve = 0; curve < CURVES; ++curve) least = min(least, sums[curve / 4][curve % 4]);
    int best = 0;
    if (weight > 0.0)
        while (best < CURVES - 1 &&
               sqrt(sums[best / 4][best % 4] / weight) > sqrt(least / weight) + equal_scores)
            ++best;
    imageStore(i_split_ratios, region, vec4(float(best) / float(CURVES - 1)));
}
