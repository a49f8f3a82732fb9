// What a fragment leaves for the picture, by the way in which that is composited: its samples come
// one after the other, the nearest to the eye first.
//     BLENDED    one premultiplied colour, `over` what lies behind
//     WEIGHTED   sums without an order: lib/camera_maps.glsl
//     COUNTED    how many samples there are, for lists
//     LISTED     each of them in the list of its texel: lib/fragment_list.glsl
//     TOLD       nothing: what is seen is told otherwise (lighting/surface.frag.glsl)
//     else       the colour of a solid
#include "lib/opacity.glsl"

#ifdef READS_SOLID_DEPTH
uniform sampler2D t_solid_depth;
uniform mat4 u_camera_clip_from_view;
#endif

// From the eye to the first solid in this texel, along a direction of length 1.
float distance_to_solid(vec3 way) {
#ifdef READS_SOLID_DEPTH
    float depth = texelFetch(t_solid_depth, ivec2(gl_FragCoord.xy), 0).x;  // near / distance
    if (depth > 0.0) return u_camera_clip_from_view[3][2] / (depth * -way.z);
#endif
    return 1e30;
}

#if defined(COUNTED)
layout(r32ui) uniform uimage2D i_sample_count;
layout(early_fragment_tests) in;
uint samples_count = 0u;

void add_sample(vec3 color, float opacity, vec3 p_vs) {
    if (opacity > 0.0) ++samples_count;
}
bool is_seen() { return true; }
void write_samples() {
    if (samples_count > 0u) imageAtomicAdd(i_sample_count, ivec2(gl_FragCoord.xy), samples_count);
}

#elif defined(LISTED)
#include "lib/fragment_list.glsl"
uniform usampler2D t_first_sample, t_sample_count;
layout(r32ui) uniform uimage2D i_stored_samples;
layout(rgba32f) writeonly uniform image2D i_sample_colors;  // opacity in alpha
layout(r32f) writeonly uniform image2D i_sample_distances;
layout(early_fragment_tests) in;

void add_sample(vec3 color, float opacity, vec3 p_vs) {
    if (!(opacity > 0.0)) return;
    ivec2 texel = ivec2(gl_FragCoord.xy);
    uint index = imageAtomicAdd(i_stored_samples, texel, 1u);
    // As many arrive as were counted; a driver that disagrees must not write into the next list.
    if (index >= texelFetch(t_sample_count, texel, 0).x) return;
    ivec2 place = list_place(texelFetch(t_first_sample, texel, 0).x + index);
    imageStore(i_sample_colors, place, vec4(color, opacity));
    imageStore(i_sample_distances, place, vec4(length(p_vs)));
}
bool is_seen() { return true; }
void write_samples() {}

#elif defined(WEIGHTED)
#include "lib/camera_maps.glsl"
layout(location = 0) out vec4 o_weighted;  // weight times colour, weight
#ifdef WRITES_OPTICAL_DEPTH
layout(location = 1) out vec4 o_optical_depth;
#endif
vec4 samples_weighted = vec4(0.0);
float samples_optical_depth = 0.0;

void add_sample(vec3 color, float opacity, vec3 p_vs) {
    samples_weighted += opacity * camera_transmittance(p_vs, opacity) * vec4(color, 1.0);
    samples_optical_depth += optical_depth_of(opacity);
}
bool is_seen() { return true; }
void write_samples() {
    o_weighted = samples_weighted;
#ifdef WRITES_OPTICAL_DEPTH
    o_optical_depth = vec4(samples_optical_depth);
#endif
}

#elif !defined(TOLD)
layout(location = 0) out vec4 o_color;

#ifdef BLENDED
vec4 samples_over = vec4(0.0);

void add_sample(vec3 color, float opacity, vec3 p_vs) {
    samples_over += (1.0 - samples_over.a) * opacity * vec4(color, 1.0);
}
// Whether what comes next may still show.
bool is_seen() { return samples_over.a < 0.9999; }
void write_samples() { o_color = samples_over; }
#else
vec3 samples_color = vec3(0.0);

void add_sample(vec3 color, float opacity, vec3 p_vs) {
#ifdef BEFORE_SOLIDS
    if (gl_FragCoord.z < texelFetch(t_solid_depth, ivec2(gl_FragCoord.xy), 0).x) discard;
#endif
    samples_color = color;
}
bool is_seen() { return true; }
void write_samples() { o_color = vec4(samples_color, 1.0); }
#endif
#endif
