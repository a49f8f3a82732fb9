// The texels of drawn layers that a search looks at, side by side: blocks of BLOCK_PX x BLOCK_PX, one
// in every BLOCK_STRIDE both ways. Behind the layers' images those of their moments, if they have any,
// and where the texel's layers begin and end. C++: techniques/histogram.cpp.
#include "lib/invocation.glsl"

uniform sampler2DArray LAYERS;
#ifdef MOMENTS
uniform sampler2DArray MOMENTS;
#endif
#ifdef HAS_SPAN
uniform sampler2D t_start, t_end;
#endif
layout(rgba32f) writeonly uniform image2DArray i_sampled_texels;

int place_in_map(int i) { return i / BLOCK_PX * BLOCK_PX * BLOCK_STRIDE + i % BLOCK_PX; }

void main() {
    ivec2 size = imageSize(i_sampled_texels).xy;
    int index = int(invocation_index());
    ivec2 here = ivec2(index % size.x, index / size.x);
    if (here.y >= size.y) return;
    ivec2 texel = ivec2(place_in_map(here.x), place_in_map(here.y));
    int image = 0;
    for (int i = 0; i < textureSize(LAYERS, 0).z; ++i)
        imageStore(i_sampled_texels, ivec3(here, image++), texelFetch(LAYERS, ivec3(texel, i), 0));
#ifdef MOMENTS
    for (int i = 0; i < textureSize(MOMENTS, 0).z; ++i)
        imageStore(i_sampled_texels, ivec3(here, image++), texelFetch(MOMENTS, ivec3(texel, i), 0));
#endif
#ifdef HAS_SPAN
    vec2 ends = vec2(texelFetch(t_start, texel, 0).x, texelFetch(t_end, texel, 0).x);
    imageStore(i_sampled_texels, ivec3(here, image), vec4(ends, 0.0, 0.0));
#endif
}
