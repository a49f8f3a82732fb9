// Adaptive opacity maps: see adaptive_opacity_maps.hpp.

#ifdef PASS_tile_planes
// Planes of a tile at equal steps of transmittance. C++: map/transmittance_steps.hpp.
#include "lib/invocation.glsl"
#include "lib/layer_map.glsl"
#include "lib/opacity.glsl"
#include "lib/tile_planes.glsl"

uniform int u_layers;
uniform float u_even_part;
layout(rgba32f) writeonly uniform image2DArray i_tile_planes;

const float last_place = 1.0 - 1.0 / 1048576.0;

// Border i of the layers that are told.
float border(int tile, int i) {
#ifdef TOLD_EVENLY
    return float(i) / float(TOLD_LAYERS);
#else
    return tile_plane(tile, i, TOLD_LAYERS);
#endif
}

// What of the light the texels of a tile take in front of it.
float taken(ivec2 tile, int i) {
    ivec2 first = tile * TILE_PX, end = min(first + TILE_PX, textureSize(t_opacity, 0).xy);
    float sum = 0.0;
    for (int y = first.y; y < end.y; ++y)
        for (int x = first.x; x < end.x; ++x) sum += opacity_of(plane_optical_depth(ivec2(x, y), i));
    return sum;
}

void main() {
    ivec2 size = imageSize(i_tile_planes).xy;
    int index = int(invocation_index());
    ivec2 tile = ivec2(index % size.x, index / size.x);
    if (tile.y >= size.y) return;
    float all = taken(tile, TOLD_LAYERS);
    int i = 0;
    vec2 before = vec2(0.0), here = vec2(0.0);  // a border, and what part of all planes lie in front
    vec4 places = vec4(no_plane);
    for (int k = 1; k < u_layers; ++k) {
        float wanted = float(k) / float(u_layers);
        while (i < TOLD_LAYERS && !(here.y > wanted)) {
            before = here;
            ++i;
            here.x = border(tile_index(tile), i);
            here.y = mix(all > 0.0 ? taken(tile, i) / all : here.x, here.x, u_even_part);
        }
        places[(k - 1) % 4] = min(mix(before.x, here.x, (wanted - before.y) / (here.y - before.y)), last_place);
        if (k % 4 != 0 && k < u_layers - 1) continue;
        imageStore(i_tile_planes, ivec3(tile, (k - 1) / 4), places);
        places = vec4(no_plane);
    }
}
#else

// Layers between the first and the last caster of each texel. With TILE_PX each tile of texels has
// planes of its own.
#include "lib/layer_span.glsl"

uniform sampler2D t_start, t_end;

TexelLayers texel_layers(ivec2 texel) {
#ifdef TILE_PX
    int curve = tile_of(texel);
#else
    int curve = 0;
#endif
    return TexelLayers(texelFetch(t_start, texel, 0).x, texelFetch(t_end, texel, 0).x, curve);
}

#include "lib/layers.glsl"
#endif
