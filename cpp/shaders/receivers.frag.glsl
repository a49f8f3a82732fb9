// Where light is asked for: the point that lighting.frag.glsl looks T up at, and the automatic bias
// there in world units; negative where no shadow falls.
in vec3 v_p_ls;

uniform float u_receiver_width;    // world units
uniform float u_light_least_bias;  // world units

layout(location = 0) out vec4 o_receiver;

void main() {
#ifdef RECEIVES
    o_receiver = vec4(v_p_ls, max(u_receiver_width, u_light_least_bias));
#else
    o_receiver = vec4(v_p_ls, -1.0);
#endif
}
