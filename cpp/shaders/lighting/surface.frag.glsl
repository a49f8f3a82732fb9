// Strands and triangles.
#ifdef TRANSLUCENT
in float v_opacity;
#endif
#ifdef OWN_CORRECTION
in float v_own_opacity;
#ifdef STRANDS
flat in vec3 v_own_direction;
in float v_own_width_texels;
in vec2 v_own_ends;
#endif
#endif

#if defined(ALPHA_MAP) || defined(COLOR_MAP)
in vec2 v_uv;
#endif
#ifdef ALPHA_MAP
uniform sampler2D t_alpha;  // coverage, and its means in the levels
#endif
#ifdef COLOR_MAP
uniform sampler2D t_color_map;
#endif

// 1 for whatever is drawn as opaque; a leaf ends where its alpha does all the same.
float opacity_here() {
    float opacity = 1.0;
#ifdef TRANSLUCENT
    opacity = v_opacity;
#endif
#ifdef ALPHA_MAP
    float coverage = texture(t_alpha, v_uv).x;
#ifdef TRANSLUCENT
    opacity *= coverage;
#else
    if (coverage < 0.5) discard;
#endif
#endif
    return opacity;
}

vec3 color_here() {
#ifdef COLOR_MAP
    return v_color * texture(t_color_map, v_uv).rgb;
#else
    return v_color;
#endif
}

Receiver receiver_here() {
    Receiver receiver = point_receiver(v_p_ls, u_receiver_width);
#ifdef STRANDS
    receiver.on_strand = true;
#endif
#ifdef OWN_CORRECTION
    receiver.opacity = v_own_opacity;
#ifdef STRANDS
    receiver.width_texels = v_own_width_texels;
    receiver.direction = v_own_direction;
    receiver.ends = v_own_ends;
#endif
#endif
#ifdef MESH
    receiver.on_surface = true;
#ifdef OPAQUE
    receiver.on_triangle = true;
#endif
    receiver.direction = surface_direction(dFdx(v_p_ls), dFdy(v_p_ls));
#endif
    return receiver;
}

vec3 shaded(vec3 color, Receiver receiver) {
    vec3 axis = v_axis_vs * inversesqrt(max(dot(v_axis_vs, v_axis_vs), 1e-30));
    vec3 to_eye = normalize(-v_p_vs);
    Arriving arriving = arriving_at(v_p_vs);
#ifdef STRANDS
    return shade_strand(color, axis, arriving.to_light, to_eye, shadowed(arriving, true, receiver));
#else
    // Real meshes have holes: whoever looks through one sees the inside lit as an inside.
    vec3 normal = dot(axis, to_eye) < 0.0 ? -axis : axis;
#ifdef OPAQUE
    bool faces_light = dot(normal, arriving.to_light) > -u_wrap;
    return shade_surface(color, normal, arriving.to_light, to_eye, shadowed(arriving, faces_light, receiver));
#else
    return shade_translucent(color, normal, arriving.to_light, shadowed(arriving, true, receiver));
#endif
#endif
}

#ifdef TOLD
uniform int u_shape_index;  // in the list that is drawn
layout(location = 0) out vec4 o_surface;  // T, distance from the eye, index

void main() {
    Receiver receiver = receiver_here();
    opacity_here();
    float transmittance = 1.0;
#ifdef RECEIVES
    transmittance = transmittance_here(receiver);
#endif
    o_surface = vec4(transmittance, length(v_p_vs), float(u_shape_index), 1.0);
}
#else
void main() {
#ifdef COUNTED
    add_sample(vec3(0.0), opacity_here(), v_p_vs);
#else
    Receiver receiver = receiver_here();  // of derivatives: in no branch
    vec3 color = color_here();
    float opacity = opacity_here();
    add_sample(shaded(color, receiver), opacity, v_p_vs);
#endif
    write_samples();
}
#endif
