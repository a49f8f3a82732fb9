// How strands, surfaces and media answer to light. Every vector is of length 1 and points away from
// the shaded point; `light` is what arrives there, colour times T.

uniform float u_ambient, u_specular, u_shininess, u_wrap, u_backlight, u_phase;

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

// Lambert's cosine, wrapped around the edge of the lit side; divided so that a ball lit from one
// side sends back as much as without.
float wrapped(float facing) { return max(0.0, facing + u_wrap) / ((1.0 + u_wrap) * (1.0 + u_wrap)); }

// Blinn 1977.
vec3 shade_surface(vec3 color, vec3 normal, vec3 to_light, vec3 to_eye, vec3 light) {
    float facing = dot(normal, to_light);
    vec3 half_way = to_light + to_eye;
    half_way *= inversesqrt(max(dot(half_way, half_way), 1e-12));
    float highlight = facing > 0.0 ? pow(max(0.0, dot(normal, half_way)), u_shininess) : 0.0;
    vec3 lit = color * wrapped(facing) + u_specular * highlight;
    return u_ambient * color + light * lit;
}

// A thin sheet: of the light on its far side the part u_backlight comes through, and the rest of
// what arrives on this side goes back. Negative: for what light passes through, the maps replace
// the cosine (thesis, section 5.3).
vec3 shade_translucent(vec3 color, vec3 normal, vec3 to_light, vec3 light) {
    if (u_backlight < 0.0) return color * (u_ambient + light);
    float facing = dot(normal, to_light);
    float diffuse = (1.0 - u_backlight) * wrapped(facing) + u_backlight * wrapped(-facing);
    return color * (u_ambient + diffuse * light);
}

// Henyey and Greenstein 1941, times 4 pi: 1 for a phase of 0; forward, away from the light, for
// more.
vec3 shade_medium(vec3 color, vec3 to_light, vec3 to_eye, vec3 light) {
    float squared = u_phase * u_phase;
    float spread = 1.0 + squared + 2.0 * u_phase * dot(to_light, to_eye);
    return color * (u_ambient + (1.0 - squared) / (spread * sqrt(spread)) * light);
}
