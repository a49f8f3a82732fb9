// Where points lie in the light's map: x and y in texels, z the linear distance along the light as a
// fraction of the casters' range: 0 at the first caster, 1 behind the last one that any receiver can
// see. C++: map/face.hpp.
//
// u_light_from_local leads to light coordinates. Without LIGHT_FACES the light is directional, and
// these are the place in the map already. With it they are offsets from the middle of the casters in
// depth ranges, and the light sees them through faces, each a perspective onto a square of the map:
// one a point of the light, or the six of a cube. With LIGHT_SPLITS the map of a directional light
// lies beside finer ones of parts of it (C++: map/split_place.hpp).

uniform int u_light_map_size_px;        // along each side of a face, or split
uniform float u_light_depth_range;      // world units from z = 0 to z = 1
// 1 / the side of a texel in world units; with faces, at one depth range before the light; with
// splits, of the whole map.
uniform float u_light_texels_per_unit;

#if defined(LIGHT_FACES)
#define MAP_FACES LIGHT_FACES
#elif defined(LIGHT_SPLITS)
#define MAP_FACES LIGHT_SPLITS
#endif

#ifdef MAP_FACES
// Nothing nearer than this before a face, in depth ranges, is seen by it.
const float least_forward = 1e-4;

uniform int u_light_columns;  // faces, or splits, side by side in the map

// The first texel of one.
ivec2 corner_px(int face) { return u_light_map_size_px * ivec2(face % u_light_columns, face / u_light_columns); }
#endif

#ifdef LIGHT_SPLITS
// Offset in texels and scale, from the whole map; that is the first.
uniform vec3 u_light_splits[LIGHT_SPLITS];

float split_scale(int split) { return u_light_splits[split].z; }
vec2 place_in(int split, vec2 p) { return split_scale(split) * p + u_light_splits[split].xy; }
vec2 place_from(int split, vec2 p) { return (p - u_light_splits[split].xy) / split_scale(split); }
#endif

#ifdef LIGHT_FACES
// Rows: right, down, forward, each with the offset r = axes q + offset; last the focal length and
// the middle of the face in texels, and the depth of q = 0.
uniform mat4 u_light_faces[LIGHT_FACES];
uniform int u_light_faces_an_eye;  // 1, or 6: forward is +z, -z, +x, -x, +y, -y

float focal_px(int face) { return u_light_faces[face][0].w; }
vec2 middle_px(int face) { return vec2(u_light_faces[face][1].w, u_light_faces[face][2].w); }

// Light coordinates to the face's axes: right, down, forward.
vec3 seen_by(int face, vec3 q) { return mat3(u_light_faces[face]) * q + u_light_faces[face][3].xyz; }

// |r| - |offset| + depth of the origin, without the digits that the difference of two long lengths
// would lose.
float depth_by(int face, vec3 q) {
    vec3 s = mat3(u_light_faces[face]) * q, offset = u_light_faces[face][3].xyz;
    float lengths = max(length(s + offset) + length(offset), 1e-30);
    return dot(s, s + 2.0 * offset) / lengths + u_light_faces[face][3].w;
}

// Only where seen_by(face, q).z > 0.
vec3 place_by(int face, vec3 q) {
    vec3 r = seen_by(face, q);
    return vec3(focal_px(face) * r.xy / r.z + middle_px(face), depth_by(face, q));
}

// How the place moves with q: the derivative of place_by along dq.
vec3 place_change_by(int face, vec3 q, vec3 dq) {
    vec3 r = seen_by(face, q), dr = mat3(u_light_faces[face]) * dq;
    return vec3(focal_px(face) * (dr.xy - r.xy * (dr.z / r.z)) / r.z, dot(r, dr) / max(length(r), 1e-30));
}

// 1 / the side of a texel in world units, so far before the face.
float texels_per_unit_by(int face, float forward) { return focal_px(face) / (forward * u_light_depth_range); }

// The width in texels, across its own direction, of a ribbon that faces the light.
float ribbon_width_by(int face, vec3 q, vec3 along, float width) {
    vec3 side = cross(mat3(u_light_faces[face]) * along, seen_by(face, q));
    side *= inversesqrt(max(dot(side, side), 1e-30));
    vec3 across = place_change_by(face, q, width * (transpose(mat3(u_light_faces[face])) * side));
    vec2 d = place_change_by(face, q, along).xy;
    return abs(d.x * across.y - d.y * across.x) * inversesqrt(max(dot(d, d), 1e-30));
}

// The face through which a point of the light sees q.
int face_of(int eye, vec3 q) {
    int first = eye * u_light_faces_an_eye;
    if (u_light_faces_an_eye == 1) return first;
    vec3 r = seen_by(first, q), a = abs(r);  // whose axes are the world's
    if (a.z >= a.x && a.z >= a.y) return first + (r.z > 0.0 ? 0 : 1);
    return a.x >= a.y ? first + (r.x > 0.0 ? 2 : 3) : first + (r.y > 0.0 ? 4 : 5);
}

#endif

// The light through the middle of a texel: at depth z it is at origin + z * direction, in light
// coordinates.
struct LightRay {
    vec3 origin, direction;
    float begin;  // nothing in front of this depth is met by it
};

#ifdef LIGHT_FACES
// Where light comes from, in light coordinates; w is 0 where that is at infinity.
vec4 light_source(int face) {
    return vec4(-(transpose(mat3(u_light_faces[face])) * u_light_faces[face][3].xyz), 1.0);
}

// `texel` within the face.
LightRay light_ray(int face, vec2 texel) {
    vec3 way = normalize(vec3((texel - middle_px(face)) / focal_px(face), 1.0));
    vec3 offset = u_light_faces[face][3].xyz;
    float begin = u_light_faces[face][3].w - length(offset);
    mat3 to_light = transpose(mat3(u_light_faces[face]));
    return LightRay(to_light * (-begin * way - offset), to_light * way, begin);
}
#else
vec4 light_source() { return vec4(0.0, 0.0, -1.0, 0.0); }

LightRay light_ray(vec2 texel) { return LightRay(vec3(texel, 0.0), vec3(0.0, 0.0, 1.0), -1e30); }
#endif
