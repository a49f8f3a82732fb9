// A mirrored depth map as it lies in front of the light. C++: techniques/depth_bounds.cpp.
#include "lib/invocation.glsl"

uniform sampler2D t_mirrored_end;
layout(r32f) writeonly uniform image2D i_end;

void main() {
    ivec2 size = imageSize(i_end);
    int index = int(invocation_index());
    ivec2 texel = ivec2(index % size.x, index / size.x);
    if (texel.y < size.y) imageStore(i_end, texel, vec4(1.0 - texelFetch(t_mirrored_end, texel, 0).x));
}
