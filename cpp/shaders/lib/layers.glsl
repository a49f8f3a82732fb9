// Opacity layers: in each texel K planes, with the optical depth in front of each. Here are the pass
// that deposits casters at them, and the look-up. Include it after a technique has said where a texel
// lays its planes, as lib/layer_span.glsl does for layers between two depths:
//     struct TexelLayers, with the start and the end of a texel's layers in light space
//     float position(TexelLayers layers, float depth), among u_planes
//     TexelLayers texel_layers(ivec2 texel)
// C++: techniques/layers_on_cpu.cpp.
#include "lib/planes.glsl"

// Plane k in 1 .. K is channel (k - 1) % 4 of layer (k - 1) / 4 of the map.
#ifdef PASS_opacity
#include "lib/deposit.glsl"

layout(location = 0) out vec4 o_planes[TARGETS];

// A search of planes looks at one block of 4 x 4 texels in every BLOCK_STRIDE, both ways: blocks,
// since rasterisers skip those that are discarded whole.
bool is_sampled(ivec2 texel) { return all(equal((texel / 4) % BLOCK_STRIDE, ivec2(0))); }

// A point counts at every plane behind its own layer, an interval in part at those inside it.
void main() {
    ivec2 texel = ivec2(gl_FragCoord.xy);
    if (!is_sampled(texel)) discard;
    Deposit deposit = deposit_or_discard();
    TexelLayers layers = texel_layers(texel);
    float first = position(layers, deposit.depth), last = position(layers, deposit.depth_end);
    int layer = layer_of(first);
    for (int target = 0; target < TARGETS; ++target) {
        ivec4 plane = 4 * (FIRST_TARGET + target) + ivec4(1, 2, 3, 4);
        vec4 part = vec4(greaterThan(plane, ivec4(layer)));
        if (last > first)
            for (int i = 0; i < 4; ++i) part[i] = counted_at(plane[i], first, last);
        o_planes[target] = deposit.optical_depth * part;
    }
}
#else

#include "lib/receiver.glsl"

uniform sampler2DArray t_opacity;

// Optical depth in front of plane k; nothing is in front of plane 0.
float plane_optical_depth(ivec2 texel, int k) {
    return k == 0 ? 0.0 : texelFetch(t_opacity, ivec3(texel, (k - 1) / 4), 0)[(k - 1) % 4];
}

float texel_optical_depth(ivec2 texel, float depth, OwnDeposit own) {
    TexelLayers layers = texel_layers(texel);
    if (!(depth > layers.start)) return 0.0;
    if (depth >= layers.end) return plane_optical_depth(texel, u_layers) - own.optical_depth;
    float x = position(layers, depth);
    int layer = layer_of(x);
    float along = (x - u_planes[layer]) / (u_planes[layer + 1] - u_planes[layer]);
    float before = plane_optical_depth(texel, layer), behind = plane_optical_depth(texel, layer + 1);
    float own_part = counted(position(layers, own.depth), position(layers, own.depth_end), layer, along);
    return mix(before, behind, along) - own.optical_depth * own_part;
}

#include "lib/lookup.glsl"
#endif
