// How much of a texel a surface with an alpha map covers: its coverage, averaged over the texel of
// the light's map, so that light passes a leaf in the distance as it passes one at hand. Filtered by
// hand, since hardware may round the weights to 8 bits. C++: map/alpha.hpp.

uniform sampler2D t_alpha;  // coverage, and its means in the levels

// `uv` repeats; a texel's middle is half of a texel from its edges.
float level_coverage(int level, vec2 uv) {
    ivec2 size = textureSize(t_alpha, level);
    precise vec2 p = (uv - floor(uv)) * vec2(size) - 0.5;
    precise vec2 below = floor(p);
    precise vec2 part = p - below;
    ivec2 first = (ivec2(below) + size) % size, second = (ivec2(below) + 1) % size;
    precise float low = mix(texelFetch(t_alpha, first, level).x,
                            texelFetch(t_alpha, ivec2(second.x, first.y), level).x, part.x);
    precise float high = mix(texelFetch(t_alpha, ivec2(first.x, second.y), level).x,
                             texelFetch(t_alpha, second, level).x, part.x);
    precise float coverage = mix(low, high, part.y);
    return coverage;
}

// The level whose tents, from texel to texel, vary as a box over one texel of the light's map does:
// half a level finer than the one whose texels are as large, since a tent is as wide as a box sqrt(2)
// times as large. `dx` and `dy` are how much uv changes from one texel of the map to the next along
// its x and y.
float coverage_level(vec2 dx, vec2 dy) {
    ivec2 size = textureSize(t_alpha, 0);
    precise vec2 x = dx * vec2(size), y = dy * vec2(size);
    precise float largest = max(max(dot(x, x), dot(y, y)), 1.0);
    precise float level = clamp(0.5 * log2(largest) - 0.5, 0.0, float(findMSB(max(size.x, size.y))));
    return level;
}

// In 0 .. 1: linear between the texels of a level, and between two levels. llvmpipe takes one level
// for the four invocations of a quad, which have the same derivatives.
float coverage_at(vec2 uv, float level) {
    int fine = int(level);
    precise float coarser = level - float(fine);
    precise float coverage = level_coverage(fine, uv);
    if (coarser > 0.0) coverage = mix(coverage, level_coverage(fine + 1, uv), coarser);
    return coverage;
}
