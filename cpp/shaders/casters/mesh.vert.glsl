// Triangles are drawn as they are: a texel is covered, or not, by its middle.
layout(std430) readonly buffer b_points { vec4 points[]; };

#ifdef LIGHT_FACES
precise out vec3 v_q;  // light coordinates
#else
precise out float v_depth;
#endif
#ifdef ALPHA_MAP
layout(std430) readonly buffer b_uvs { vec2 uvs[]; };
precise out vec2 v_uv;
#endif
#ifdef OPTICAL_DEPTH
out float v_opacity;
#endif

void place_caster() {
    vec3 p_ls = (u_light_from_local * vec4(points[gl_VertexID].xyz, 1.0)).xyz;
#ifdef ALPHA_MAP
    v_uv = uvs[gl_VertexID];
#endif
#ifdef OPTICAL_DEPTH
    v_opacity = opacity[gl_VertexID * u_opacity_stride];
#endif
#ifdef LIGHT_FACES
    v_q = p_ls;
    gl_Position = clip_from_seen(seen_by(drawn_face(), v_q));
#else
    v_depth = p_ls.z;
    gl_Position = clip_from_texels(drawn_place(p_ls).xy);
#endif
}
