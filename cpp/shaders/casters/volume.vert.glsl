// A volume is drawn slab by slab, across that of its axes which runs most along the light; of each
// slab the faces that look away from the light, so that a texel gets one fragment, also where the
// light is inside. Which faces these are is told from the light's place among the voxels: a mirrored
// transform turns triangles round.
#include "lib/quad.glsl"

uniform mat4 u_light_from_voxels, u_voxels_from_light;
// Two vectors a slab: its first corner in voxels and the axis that it lies across, its last corner.
layout(std430) readonly buffer b_slabs { vec4 slabs[]; };

flat out vec3 v_slab_begin, v_slab_end;  // voxels

int longest_axis(vec3 v) {
    vec3 size = abs(v);
    if (size.x >= size.y && size.x >= size.z) return 0;
    return size.y >= size.z ? 1 : 2;
}

uniform sampler3D t_extinction;

void place_caster() {
    int face = quad_index() % 6, axis = face / 2, slab = quad_index() / 6;
    vec4 begin = slabs[2 * slab], end = slabs[2 * slab + 1];
    v_slab_begin = begin.xyz, v_slab_end = end.xyz;
#ifdef LIGHT_FACES
    vec4 light = u_voxels_from_light * light_source(drawn_face());
#else
    vec4 light = u_voxels_from_light * light_source();  // w: 0 at infinity
#endif
    // One axis for all slabs, or they would overlap.
    vec3 middle = 0.5 * vec3(textureSize(t_extinction, 0));
    bool is_last = face % 2 == 1;
    float side = light.w * (is_last ? end : begin)[axis] - light[axis];
    bool looks_away = is_last ? side > 0.0 : side < 0.0;
    if (longest_axis(light.w * middle - light.xyz) != int(begin.w) || !looks_away) {
        gl_Position = clipped_away();
        return;
    }
    vec3 p = is_last ? end.xyz : begin.xyz;
    vec2 corner = quad_corner();
    int u = (axis + 1) % 3, v = (axis + 2) % 3;
    p[u] = corner.x > 0.5 ? end[u] : begin[u];
    p[v] = corner.y > 0.5 ? end[v] : begin[v];
    vec3 p_ls = (u_light_from_voxels * vec4(p, 1.0)).xyz;
#ifdef LIGHT_FACES
    gl_Position = clip_from_seen(seen_by(drawn_face(), p_ls));
#else
    gl_Position = clip_from_texels(drawn_place(p_ls).xy);
#endif
}
