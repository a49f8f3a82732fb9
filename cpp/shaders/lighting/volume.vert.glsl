// The faces of a volume's box that are seen from inside, which are there from wherever one looks:
// one fragment for each ray. They pass every depth test, since the box may begin in front of what
// hides them.
uniform mat4 u_camera_from_voxels, u_voxels_from_camera, u_light_from_voxels;
uniform sampler3D t_extinction;

out vec3 v_p_voxels;  // a voxel is one unit long

// Corner 0 .. 3, around face 0 .. 5: two for each axis, the nearer to the first voxel first.
vec3 box_corner(int face, int corner, vec3 size) {
    int axis = face / 2;
    vec3 p = vec3(0.0);
    p[axis] = face % 2 == 0 ? 0.0 : size[axis];
    p[(axis + 1) % 3] = corner == 1 || corner == 2 ? size[(axis + 1) % 3] : 0.0;
    p[(axis + 2) % 3] = corner < 2 ? 0.0 : size[(axis + 2) % 3];
    return p;
}

void main() {
    int face = gl_VertexID / 4;
    vec3 size = vec3(textureSize(t_extinction, 0));
    vec3 eye = u_voxels_from_camera[3].xyz;
    int axis = face / 2 % 3;
    bool from_inside = face % 2 == 0 ? eye[axis] > 0.0 : eye[axis] < size[axis];
    v_p_voxels = box_corner(face % 6, gl_VertexID % 4, size);
    v_p_vs = (u_camera_from_voxels * vec4(v_p_voxels, 1.0)).xyz;
    v_p_ls = (u_light_from_voxels * vec4(v_p_voxels, 1.0)).xyz;
    v_color = color_of(0);
    v_axis_vs = vec3(0.0);
    v_opacity = 0.0;
    gl_Position = u_camera_clip_from_view * vec4(v_p_vs, 1.0);
    gl_Position.z = gl_Position.w;
    // The buffer of indices is that of slabs: it has more faces.
    if (face >= 6 || !from_inside) gl_Position = vec4(2.0, 2.0, 0.0, 1.0);
}
