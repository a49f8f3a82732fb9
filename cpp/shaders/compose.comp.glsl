// The picture: what each light adds, summed, and the mean of n x n samples a pixel.
#include "lib/invocation.glsl"

uniform sampler2DArray t_lit;  // a layer a light; the first has the background and alpha
layout(rgba32f) writeonly uniform image2D i_image;

vec4 composed(ivec2 sample_place) {
    vec4 sum = texelFetch(t_lit, ivec3(sample_place, 0), 0);
    for (int light = 1; light < textureSize(t_lit, 0).z; ++light)
        sum.rgb += texelFetch(t_lit, ivec3(sample_place, light), 0).rgb;
    return sum;
}

void main() {
    int index = int(invocation_index());
    ivec2 size = imageSize(i_image);
    if (index >= size.x * size.y) return;
    ivec2 pixel = ivec2(index % size.x, index / size.x);
    int n = textureSize(t_lit, 0).x / size.x;
    vec4 sum = vec4(0.0);
    for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x) sum += composed(n * pixel + ivec2(x, y));
    imageStore(i_image, pixel, sum / float(n * n));
}
