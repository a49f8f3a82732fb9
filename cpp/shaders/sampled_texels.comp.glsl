// Blocks of a map's texels side by side, of all images of an array or of a plain map: what a search of
// planes reads back. C++: techniques/histogram.cpp.
#include "lib/block_sample.glsl"
#include "lib/invocation.glsl"

#ifdef ARRAY
uniform sampler2DArray MAP;
layout(FORMAT) writeonly uniform image2DArray SAMPLED;
#else
uniform sampler2D MAP;
layout(FORMAT) writeonly uniform image2D SAMPLED;
#endif

void main() {
    ivec2 size = imageSize(SAMPLED).xy;
    int index = int(invocation_index());
    ivec2 place = ivec2(index % size.x, index / size.x);
    if (place.y >= size.y) return;
    ivec2 texel = unpacked_texel(place);
#ifdef ARRAY
    for (int i = 0; i < textureSize(MAP, 0).z; ++i)
        imageStore(SAMPLED, ivec3(place, i), texelFetch(MAP, ivec3(texel, i), 0));
#else
    imageStore(SAMPLED, place, texelFetch(MAP, texel, 0));
#endif
}
