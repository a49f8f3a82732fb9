// The voxels that a ray passes, one after the other, before anything opaque: each is one sample,
// lit at the middle of its part of the ray. Empty ones cost a fetch.
in vec3 v_p_voxels;  // where the ray leaves the box

uniform sampler3D t_extinction;
uniform mat4 u_camera_from_voxels, u_voxels_from_camera, u_light_from_voxels;
uniform vec3 u_voxel_size;  // of the shape's units, as its extinction is
uniform float u_width_scale;

vec3 shaded(vec3 p_voxels, vec3 to_eye) {
    vec3 p_vs = (u_camera_from_voxels * vec4(p_voxels, 1.0)).xyz;
    vec3 p_ls = (u_light_from_voxels * vec4(p_voxels, 1.0)).xyz;
    Arriving arriving = arriving_at(p_vs);
    float half_voxel = 0.5 * min(min(u_voxel_size.x, u_voxel_size.y), u_voxel_size.z) * u_width_scale;
    vec3 light = shadowed(arriving, true, point_receiver(p_ls, half_voxel));
    return shade_medium(v_color, arriving.to_light, to_eye, light);
}

// The part of the ray in the box, 0 at the eye and 1 where it leaves.
vec2 part_inside(vec3 eye, vec3 along, vec3 size) {
    vec3 begins = min(-eye / along, (size - eye) / along);
    float begin = max(max(begins.x, begins.y), max(begins.z, 0.0));
    vec3 way = normalize(v_p_vs);
    return vec2(begin, min(1.0, distance_to_solid(way) / length(v_p_vs)));
}

void main() {
    vec3 size = vec3(textureSize(t_extinction, 0));
    vec3 eye = u_voxels_from_camera[3].xyz, along = v_p_voxels - eye;
    along = mix(along, vec3(1e-20), lessThan(abs(along), vec3(1e-20)));
    vec2 part = part_inside(eye, along, size);
    if (!(part.y > part.x)) discard;
    vec3 to_eye = normalize(-v_p_vs);
    float unit_length = length(along * u_voxel_size);
    vec3 onward = step(0.0, along);  // from a voxel's first corner to the one that the ray leaves by
    ivec3 voxel = ivec3(clamp(floor(eye + part.x * along), vec3(0.0), size - 1.0));
    int most = int(size.x + size.y + size.z) + 3;
    float at = part.x;
    for (int i = 0; i < most && at < part.y && is_seen(); ++i) {
        vec3 ends = (vec3(voxel) + onward - eye) / along;
        float next = min(min(ends.x, ends.y), min(ends.z, part.y));
        float extinction = texelFetch(t_extinction, voxel, 0).x;
        if (extinction > 0.0 && next > at) {
            float middle = 0.5 * (at + next);
            vec3 color = vec3(0.0);
#ifndef COUNTED
            color = shaded(eye + middle * along, to_eye);
#endif
            add_sample(color, opacity_of(extinction * (next - at) * unit_length), middle * v_p_vs);
        }
        voxel += ivec3(sign(along)) * ivec3(equal(ends, vec3(min(min(ends.x, ends.y), ends.z))));
        if (any(lessThan(voxel, ivec3(0))) || any(greaterThanEqual(voxel, ivec3(size)))) break;
        at = max(at, next);
    }
    write_samples();
}
