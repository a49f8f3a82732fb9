// What a receiver on a strand's segment knows of itself at either end (lib/receiver.glsl); between
// them all of it changes evenly. Include it after lib/light.glsl, lib/ribbon.glsl, lib/segment.glsl
// and lib/vertex_opacity.glsl; C++: map/receiver.cpp.
uniform int u_segment_count;

// Whether the strand goes on beyond the segment's root or tip.
bool goes_on(int segment, bool at_tip) {
    int neighbour = at_tip ? segment + 1 : segment - 1;
    return neighbour >= 0 && neighbour < u_segment_count &&
           int(segments[neighbour]) == int(segments[segment]) + (at_tip ? 1 : -1);
}

#ifdef OWN_CORRECTION
#ifdef FEWER_STRANDS
// What the light's map holds of them: scene/strand_ranks.hpp.
layout(std430) readonly buffer b_strand_ranks { float strand_ranks[]; };  // of each segment
uniform float u_light_strand_detail, u_light_strand_widening;
bool is_in_map(int segment) { return strand_ranks[segment] < u_light_strand_detail; }
#else
const float u_light_strand_widening = 1.0;
bool is_in_map(int segment) { return true; }
#endif

struct StrandEnd {
    vec3 direction;
    vec2 ends;
    float width_texels, opacity;
};

#ifdef LIGHT_FACES
const float endless = 1e6;  // segments
#else
const float endless = endless_texels;
#endif

StrandEnd strand_end(int segment, bool at_tip) {
    int root = int(segments[segment]), point = root + (at_tip ? 1 : 0);
    vec3 along = (u_light_from_local * vec4(points[root + 1].xyz - points[root].xyz, 0.0)).xyz;
    StrandEnd end;
#ifdef LIGHT_FACES
    float texels = 1.0;  // ends are told in segments: a face will know how long one is
    end.direction = along;
#else
    float texels = max(abs(along.x), abs(along.y));
    end.direction = texels > 0.0 ? along / texels : vec3(0.0);
#endif
    end.ends = vec2(goes_on(segment, false) ? -endless : at_tip ? -texels : 0.0,
                    goes_on(segment, true) ? endless : at_tip ? 0.0 : texels);
    end.width_texels = points[point].w * u_width_scale * u_light_texels_per_unit * u_light_strand_widening;
    end.opacity = is_in_map(segment) ? vertex_opacity(point) : 0.0;
    return end;
}
#endif
