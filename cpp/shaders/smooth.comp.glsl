// The mean of the texels around each, within their face: of a depth map of those with casters, or with
// LAYERS of opacity layers. C++: techniques/smoothing.cpp.
#include "lib/invocation.glsl"
#include "lib/light.glsl"

uniform int u_smoothing;  // texels to each side
uniform sampler2D t_start;

#ifdef LAYERS
#include "lib/layer_map.glsl"
#if PLANES_AN_IMAGE == 4
layout(rgba32f) writeonly uniform image2DArray i_opacity;
#else
layout(r32f) writeonly uniform image2DArray i_opacity;
#endif
#else
layout(r32f) writeonly uniform image2D i_start;
#endif

void main() {
#ifdef LAYERS
    ivec3 size = textureSize(t_opacity, 0);
#else
    ivec3 size = ivec3(textureSize(t_start, 0), 1);
#endif
    int index = int(invocation_index());
    if (index >= size.x * size.y * size.z) return;
    ivec3 texel = ivec3(index % size.x, index / size.x % size.y, index / (size.x * size.y));
    ivec2 corner = texel.xy / u_light_map_size_px * u_light_map_size_px;
    ivec2 first = max(texel.xy - u_smoothing, corner);
    ivec2 last = min(texel.xy + u_smoothing, corner + u_light_map_size_px - 1);
    vec4 sum = vec4(0.0);
    float count = 0.0;
    for (int y = first.y; y <= last.y; ++y)
        for (int x = first.x; x <= last.x; ++x) {
#ifdef LAYERS
            sum += texelFetch(t_opacity, ivec3(x, y, texel.z), 0);
            count += 1.0;
#else
            float depth = texelFetch(t_start, ivec2(x, y), 0).x;
            if (depth >= 1.0) continue;  // no caster
            sum.x += depth;
            count += 1.0;
#endif
        }
#ifdef LAYERS
    vec4 mean = sum / count;
#ifdef PACKED
    if (texel.z == start_slot / PLANES_AN_IMAGE)  // smooth already
        mean[start_slot % PLANES_AN_IMAGE] = texelFetch(t_start, texel.xy, 0).x;
#endif
    imageStore(i_opacity, texel, mean);
#else
    imageStore(i_start, texel.xy, vec4(count > 0.0 ? sum.x / count : 1.0));
#endif
}
