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
    end.width_texels = points[point].w * u_width_scale * u_light_texels_per_unit;
    end.opacity = vertex_opacity(point);
    return end;
}
#endif
