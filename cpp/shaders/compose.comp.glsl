// The picture from what each light adds, sample by sample, and the mean of n x n samples a pixel.
#include "lib/invocation.glsl"

// Arrays of a layer a light. Alpha is the same in all of them, and the background in the first.
uniform sampler2DArray t_lit;  // solids
#ifdef PARTS
uniform sampler2DArray t_parts;  // of each light, one after the other: as if each were all
#endif
#ifdef OVER
uniform sampler2DArray t_over;  // premultiplied
#endif
#ifdef WEIGHTED
uniform sampler2DArray t_weighted;  // weight times colour, weight
uniform sampler2D t_optical_depth;
#endif
layout(rgba32f) writeonly uniform image2D i_image;

vec4 over(vec4 front, vec4 back) { return front + (1.0 - front.a) * back; }

vec4 composed(ivec2 place, int light) {
    vec4 color = texelFetch(t_lit, ivec3(place, light), 0);
#ifdef PARTS
    vec4 sum = vec4(0.0);
    for (int part = 0; part < PARTS; ++part)
        sum += over(texelFetch(t_parts, ivec3(place, PARTS * light + part), 0), color);
    color = sum / float(PARTS);
#endif
#ifdef OVER
    color = over(texelFetch(t_over, ivec3(place, light), 0), color);
#endif
#ifdef WEIGHTED
    // Order-independent: the opacity is exact, the colour a mean by what the camera sees of each
    // (Muenstermann et al. 2018 normalise the same way).
    vec4 weighted = texelFetch(t_weighted, ivec3(place, light), 0);
    float opacity = 1.0 - exp(-texelFetch(t_optical_depth, place, 0).x);
    if (weighted.a > 0.0) color = over(vec4(weighted.rgb / weighted.a, 1.0) * opacity, color);
#endif
    return color;
}

void main() {
    int index = int(invocation_index());
    ivec2 size = imageSize(i_image);
    if (index >= size.x * size.y) return;
    ivec2 pixel = ivec2(index % size.x, index / size.x);
    int n = textureSize(t_lit, 0).x / size.x;
    vec4 sum = vec4(0.0);
    for (int i = 0; i < n * n; ++i) {
        ivec2 place = n * pixel + ivec2(i % n, i / n);
        sum += composed(place, 0);
        for (int light = 1; light < textureSize(t_lit, 0).z; ++light)
            sum.rgb += composed(place, light).rgb;
    }
    imageStore(i_image, pixel, sum / float(n * n));
}
