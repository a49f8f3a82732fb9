// A particle becomes the square of all texels that its disc touches.
#include "casters/particles.glsl"
#include "lib/quad.glsl"

void place_caster() {
    vec2 low, high;
    place_particle(quad_index(), low, high);
    gl_Position = clip_from_texels(mix(low, high, quad_corner()));
}
