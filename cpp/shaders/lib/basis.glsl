// A basis f_k of [0, 1], in which the density of the casters along a texel is told (Jansen and Bavoil
// 2010, section 5). Each is a file under bases/, as
//     struct Means, Integrals                            how far their rows have been told
//     Means means_over(float begin, float end)
//     float next_mean(inout Means means, int k)          of f_k from begin to end; of a point f_k there
//     Integrals integrals_to(float d)
//     float next_integral(inout Integrals means, int k)  g_k, from 0 to d
//     float whole_integral(int k)                        g_k(1)
// where k is 0, 1, 2 .. in turn: arrays of 63 take llvmpipe a minute to compile. C++: map/basis.hpp.
#if defined(BASIS_fourier)
#include "lib/bases/fourier.glsl"
#elif defined(BASIS_piecewise_constant)
#include "lib/bases/piecewise_constant.glsl"
#elif defined(BASIS_cosine)
#include "lib/bases/cosine.glsl"
#elif defined(BASIS_legendre)
#include "lib/bases/legendre.glsl"
#endif
