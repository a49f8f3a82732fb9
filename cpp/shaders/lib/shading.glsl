// How a surface and a strand answer to light. Every vector is of length 1 and points away from the
// shaded point; `light` is what arrives there, colour times T.

uniform float u_ambient, u_specular, u_shininess;

// Kajiya and Kay 1989: a thin cylinder has no side that faces away, so only the maps darken it. The
// highlight leaves on the cone that mirrors the light about the strand.
vec3 shade_strand(vec3 color, vec3 tangent, vec3 to_light, vec3 to_eye, vec3 light) {
    float along_light = dot(tangent, to_light), along_eye = dot(tangent, to_eye);
    float across_light = sqrt(max(0.0, 1.0 - along_light * along_light));
    float across_eye = sqrt(max(0.0, 1.0 - along_eye * along_eye));
    float mirrored = max(0.0, across_light * across_eye - along_light * along_eye);
    vec3 lit = color * across_light + u_specular * pow(mirrored, u_shininess);
    return u_ambient * color + light * lit;
}

// Blinn 1977.
vec3 shade_surface(vec3 color, vec3 normal, vec3 to_light, vec3 to_eye, vec3 light) {
    float facing = max(0.0, dot(normal, to_light));
    vec3 half_way = to_light + to_eye;
    half_way *= inversesqrt(max(dot(half_way, half_way), 1e-12));
    float highlight = facing > 0.0 ? pow(max(0.0, dot(normal, half_way)), u_shininess) : 0.0;
    vec3 lit = color * facing + u_specular * highlight;
    return u_ambient * color + light * lit;
}

// Thesis, section 5.3: for what light passes through, the maps replace the diffuse term.
vec3 shade_translucent(vec3 color, vec3 light) {
    return color * (u_ambient + light);
}
