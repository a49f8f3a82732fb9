// Opacity and optical depth: tau = -log(1 - opacity), T = exp(-tau).

// The largest opacity that still has an optical depth (16.6); 1 itself is for the opaque depth map.
const float largest_opacity = 1.0 - 1.0 / 16777216.0;

// -log(1 - opacity) to a few ulp. GPUs have no log1p, and log near 1 loses every digit of a small
// opacity; below one half the series of 2 atanh(t) is used instead, whose first term left out is
// below 2e-8 of the sum.
float optical_depth_of(float opacity) {
    float a = clamp(opacity, 0.0, largest_opacity);
    float t = a / (2.0 - a);
    float s = t * t;
    float series = 1.0 / 13.0;
    series = series * s + 1.0 / 11.0;
    series = series * s + 1.0 / 9.0;
    series = series * s + 1.0 / 7.0;
    series = series * s + 1.0 / 5.0;
    series = series * s + 1.0 / 3.0;
    series = series * s + 1.0;
    return a < 0.5 ? 2.0 * t * series : -log(1.0 - a);
}

// 1 - exp(-tau), in the same way.
float opacity_of(float optical_depth) {
    float x = optical_depth;
    if (!(x < 0.5)) return 1.0 - exp(-x);
    float series = 1.0 - x / 7.0;
    series = 1.0 - x / 6.0 * series;
    series = 1.0 - x / 5.0 * series;
    series = 1.0 - x / 4.0 * series;
    series = 1.0 - x / 3.0 * series;
    series = 1.0 - x / 2.0 * series;
    return x * series;
}
