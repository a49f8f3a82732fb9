// Spheres as squares across the way to their middle, that touch them in front: so that a square
// hides nothing which the sphere does not. From within a sphere, the square is the whole picture.
layout(std430) readonly buffer b_points { vec4 points[]; };  // w: radius
uniform float u_width_scale;

flat out vec3 v_center_vs;
flat out float v_radius;  // view space

void main() {
    int particle = gl_VertexID / 4, corner = gl_VertexID % 4;
    vec2 side = vec2(corner == 1 || corner == 2 ? 1.0 : -1.0, corner < 2 ? -1.0 : 1.0);
    vec3 center = view_position(points[particle].xyz);
    v_center_vs = center;
    v_radius = points[particle].w * u_width_scale;
    v_p_ls = (u_light_from_local * vec4(points[particle].xyz, 1.0)).xyz;
    v_color = color_of(particle);
    v_axis_vs = vec3(0.0);
    v_opacity = vertex_opacity(particle);
    float distance = length(center);
    if (distance <= v_radius * 1.0001) {
        v_p_vs = vec3(side / vec2(u_camera_clip_from_view[0][0], u_camera_clip_from_view[1][1]), -1.0);
    } else {
        vec3 way = center / distance;
        vec3 across = unit(cross(way, abs(way.y) < 0.9 ? vec3(0.0, 1.0, 0.0) : vec3(1.0, 0.0, 0.0)));
        float half_side = v_radius * sqrt((distance - v_radius) / (distance + v_radius));
        v_p_vs = way * (distance - v_radius) + half_side * (side.x * across + side.y * cross(way, across));
    }
    gl_Position = u_camera_clip_from_view * vec4(v_p_vs, 1.0);
    if (distance <= v_radius * 1.0001) gl_Position.z = gl_Position.w;
}
