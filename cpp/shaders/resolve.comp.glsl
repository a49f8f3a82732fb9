// The mean of n x n samples.
layout(local_size_x = 8, local_size_y = 8) in;
uniform sampler2D t_samples;
layout(rgba32f) writeonly uniform image2D i_average;
uniform int u_oversampling;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(i_average)))) return;
    ivec2 first = pixel * u_oversampling;
    vec4 sum = vec4(0.0);
    for (int y = 0; y < u_oversampling; ++y)
        for (int x = 0; x < u_oversampling; ++x) sum += texelFetch(t_samples, first + ivec2(x, y), 0);
    imageStore(i_average, pixel, sum / float(u_oversampling * u_oversampling));
}
