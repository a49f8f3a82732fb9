// Triangles, with their places on the maps where they have some.
layout(std430) readonly buffer b_points { vec4 points[]; };
layout(std430) readonly buffer b_normals { vec4 normals[]; };
uniform mat3 u_camera_normal_from_local;

#if defined(ALPHA_MAP) || defined(COLOR_MAP)
layout(std430) readonly buffer b_uvs { vec2 uvs[]; };
out vec2 v_uv;
#endif

void main() {
    v_p_vs = view_position(points[gl_VertexID].xyz);
    v_p_ls = (u_light_from_local * vec4(points[gl_VertexID].xyz, 1.0)).xyz;
    v_axis_vs = unit(u_camera_normal_from_local * normals[gl_VertexID].xyz);
    v_color = color_of(gl_VertexID);
#ifdef TRANSLUCENT
    v_opacity = vertex_opacity(gl_VertexID);
#endif
#if defined(ALPHA_MAP) || defined(COLOR_MAP)
    v_uv = uvs[gl_VertexID];
#endif
#ifdef OWN_CORRECTION
    v_own_opacity = vertex_opacity(gl_VertexID);
#endif
    gl_Position = u_camera_clip_from_view * vec4(v_p_vs, 1.0);
}
