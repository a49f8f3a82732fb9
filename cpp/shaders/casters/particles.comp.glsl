// Every texel that a particle's disc touches.
#include "casters/particles.glsl"

void visit_caster(int particle) {
    vec2 low, high;
    place_particle(particle, low, high);
    ivec2 first = ivec2(on_face(low)), last = ivec2(on_face(high));
    for (int y = first.y; y < last.y; ++y)
        for (int x = first.x; x < last.x; ++x) visit_texel(ivec2(x, y));
}
