// One step of a prefilter: see techniques/prefilter.hpp. With WEIGHTS the weighted mean of the texels to
// both sides, along an AXIS; with HALVES from level - 1 of a mip chain the next, whose texels at the far
// edge of a face stand for what there is of four; with SPREAD that level as large as the map.
#include "lib/invocation.glsl"
#include "lib/light.glsl"

uniform sampler2DArray t_coefficients;
layout(rgba32f) writeonly uniform image2DArray i_coefficients;

// Of a face, in texels of so coarse a level.
int side_at(int level) { return (u_light_map_size_px + (1 << level) - 1) >> level; }

vec4 texel_at(ivec2 face, int side, ivec2 place, int layer) {
    return texelFetch(t_coefficients, ivec3(face * side + place, layer), 0);
}

#if defined(WEIGHTS)
const int level = 0;
uniform int u_reach;              // texels to each side
uniform float u_weights[WEIGHTS];  // of the texel itself, of the next ..

vec4 filtered(ivec2 face, ivec2 place, int layer) {
    vec4 sum = vec4(0.0);
    float weights = 0.0;
    for (int i = -u_reach; i <= u_reach; ++i) {
        ivec2 there = place;
        there[AXIS] += i;
        if (there[AXIS] < 0 || there[AXIS] >= u_light_map_size_px) continue;
        sum += u_weights[abs(i)] * texel_at(face, u_light_map_size_px, there, layer);
        weights += u_weights[abs(i)];
    }
    return sum / weights;
}
#elif defined(HALVES)
const int level = HALVES;

// Texels of the map that one of the level before stands for.
int length_of(int i) { return min((i + 1) << (level - 1), u_light_map_size_px) - (i << (level - 1)); }

vec4 filtered(ivec2 face, ivec2 place, int layer) {
    int side = side_at(level - 1);
    vec4 sum = vec4(0.0);
    float area = 0.0;
    for (int i = 0; i < 4; ++i) {
        ivec2 there = 2 * place + ivec2(i % 2, i / 2);
        if (any(greaterThanEqual(there, ivec2(side)))) continue;
        float weight = float(length_of(there.x) * length_of(there.y));
        sum += weight * texel_at(face, side, there, layer);
        area += weight;
    }
    return sum / area;
}
#elif defined(SPREAD)
const int level = 0;

vec4 filtered(ivec2 face, ivec2 place, int layer) {
    int side = side_at(SPREAD);
    vec2 p = (vec2(place) + 0.5) / float(1 << SPREAD) - 0.5;
    ivec2 below = ivec2(floor(p));
    vec2 part = p - vec2(below);
    ivec2 first = clamp(below, ivec2(0), ivec2(side - 1)), last = clamp(below + 1, ivec2(0), ivec2(side - 1));
    vec4 low = mix(texel_at(face, side, first, layer), texel_at(face, side, ivec2(last.x, first.y), layer), part.x);
    vec4 high = mix(texel_at(face, side, ivec2(first.x, last.y), layer), texel_at(face, side, last, layer), part.x);
    return mix(low, high, part.y);
}
#endif

void main() {
    ivec3 size = imageSize(i_coefficients);
    int index = int(invocation_index()), side = side_at(level);
    if (index >= size.x * size.y * size.z) return;
    ivec3 texel = ivec3(index % size.x, index / size.x % size.y, index / (size.x * size.y));
    imageStore(i_coefficients, texel, filtered(texel.xy / side, texel.xy % side, texel.z));
}
