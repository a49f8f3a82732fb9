// A ray through voxels of constant extinction (3D-DDA, Amanatides and Woo 1987). C++: map/voxels.hpp.

uniform sampler3D t_extinction;  // per unit of length in the shape's coordinates
uniform vec3 u_voxel_size;       // in the shape's coordinates

// At depth t it is at origin + t * direction, in voxels; nothing in front of `begin` is met.
struct VoxelRay {
    vec3 origin, direction;
    float begin;
};

// From where it enters the first voxel that is not empty to where it leaves the last one.
struct VoxelChord {
    float begin, end;
    float optical_depth;
};

// What the ray meets of the voxels from `low` up to `high`; false: nothing.
bool voxel_chord(VoxelRay ray, ivec3 low, ivec3 high, out VoxelChord chord) {
    chord = VoxelChord(0.0, 0.0, 0.0);
    float t = ray.begin, t_end = 1e30;
    for (int axis = 0; axis < 3; ++axis) {
        float from = ray.origin[axis], along = ray.direction[axis];
        if (along == 0.0) {
            if (from < float(low[axis]) || !(from < float(high[axis]))) return false;
            continue;
        }
        precise float a = (float(low[axis]) - from) / along;
        precise float b = (float(high[axis]) - from) / along;
        t = max(t, min(a, b));
        t_end = min(t_end, max(a, b));
    }
    if (!(t < t_end)) return false;

    precise vec3 entry = ray.origin + t * ray.direction;
    ivec3 voxel = clamp(ivec3(floor(entry)), low, high - 1);
    ivec3 ahead = ivec3(greaterThan(ray.direction, vec3(0.0)));
    precise float density = 0.0;  // extinction times depth
    bool met = false;
    int most = (high.x - low.x) + (high.y - low.y) + (high.z - low.z);
    for (int turn = 0; turn < most; ++turn) {
        // Where the ray leaves the voxel, and through which face.
        float leaves = t_end;
        int axis = -1;
        for (int i = 0; i < 3; ++i) {
            precise float wall = (float(voxel[i] + ahead[i]) - ray.origin[i]) / ray.direction[i];
            if (ray.direction[i] != 0.0 && wall < leaves) leaves = wall, axis = i;
        }
        leaves = max(leaves, t);
        float extinction = texelFetch(t_extinction, voxel, 0).x;
        if (extinction > 0.0 && leaves > t) {
            if (!met) chord.begin = t;
            met = true;
            chord.end = leaves;
            density += extinction * (leaves - t);
        }
        t = leaves;
        if (axis < 0) break;
        voxel[axis] += ray.direction[axis] > 0.0 ? 1 : -1;
        if (voxel[axis] < low[axis] || voxel[axis] >= high[axis]) break;
    }
    precise vec3 unit = ray.direction * u_voxel_size;
    precise float units = sqrt(unit.x * unit.x + unit.y * unit.y + unit.z * unit.z);
    chord.optical_depth = density * units;
    return met;
}
