// A slab of voxels in a texel: the interval from the first to the last one that is not empty, on the
// ray through the texel's middle.
#include "lib/voxels.glsl"

uniform mat4 u_voxels_from_light;

flat in vec3 v_slab_begin, v_slab_end;

bool covers(out Deposit deposit) {
#ifdef LIGHT_FACES
    LightRay light = light_ray(drawn_face(), texel_in_face());
#elif defined(LIGHT_SPLITS)
    LightRay light = light_ray(place_from(drawn_face(), texel_in_face()));
#else
    LightRay light = light_ray(gl_FragCoord.xy);
#endif
    precise vec3 origin = u_voxels_from_light[0].xyz * light.origin.x + u_voxels_from_light[1].xyz * light.origin.y +
                          u_voxels_from_light[2].xyz * light.origin.z + u_voxels_from_light[3].xyz;
    precise vec3 direction = u_voxels_from_light[0].xyz * light.direction.x +
                             u_voxels_from_light[1].xyz * light.direction.y +
                             u_voxels_from_light[2].xyz * light.direction.z;
    VoxelChord chord;
    bool covered = voxel_chord(VoxelRay(origin, direction, light.begin), ivec3(v_slab_begin), ivec3(v_slab_end), chord);
    deposit = Deposit(chord.begin, chord.end, chord.optical_depth);
    return covered;
}
