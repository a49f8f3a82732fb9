// Fourier opacity maps: see fourier_opacity_maps.hpp.
#include "lib/basis.glsl"
#include "lib/layer_span.glsl"

#ifdef BOUNDS_per_texel
uniform sampler2D t_start, t_end;

TexelLayers texel_layers(ivec2 texel) {
    return TexelLayers(texelFetch(t_start, texel, 0).x, texelFetch(t_end, texel, 0).x, 0);
}
#else
TexelLayers texel_layers(ivec2 texel) { return TexelLayers(0.0, 1.0, 0); }
#endif

// What is left free at both ends of the basis, of its whole.
uniform float u_inset;
float inset(float x) { return mix(u_inset, 1.0 - u_inset, x); }

Means caster_means(float begin, float end) { return means_over(inset(begin), inset(end)); }

#ifndef PASS_coefficients
#ifdef WINDOW
uniform float u_window_factors[COEFFICIENTS];
float window_factor(int k) { return u_window_factors[k]; }
#else
float window_factor(int k) { return 1.0; }
#endif

// T(d) = exp(-sum a_k g_k(d)): Jansen and Bavoil 2010, section 5.
struct Sums {
    Integrals integrals;
    float whole, before;
};

Sums sums_at(float x) { return Sums(integrals_to(inset(x)), 0.0, 0.0); }

void add(inout Sums sums, int k, float c) {
    sums.whole += whole_integral(k) * c;
    sums.before += window_factor(k) * c * next_integral(sums.integrals, k);
}

float whole_optical_depth(Sums sums) { return sums.whole; }
float optical_depth_before(Sums sums, float all) { return sums.before; }
#endif

#include "lib/coefficients.glsl"
