#include "gl/present.hpp"

#include <span>

#include "gl/check.hpp"

namespace opacity::gl {
namespace {

// Here and not under shaders/, because they belong to the
// window, which works whatever OPACITY_SHADER_DIR says.
constexpr const char* vertex_text = R"(
out vec2 v_uv;
void main() {
    vec2 corner = vec2(gl_VertexID == 1 ? 2.0 : 0.0, gl_VertexID == 2 ? 2.0 : 0.0);
    v_uv = vec2(corner.x, 1.0 - corner.y);  // the picture's rows start at the top
    gl_Position = vec4(2.0 * corner - 1.0, 0.0, 1.0);
}
)";
constexpr const char* fragment_text = R"(
in vec2 v_uv;
out vec4 o_color;
uniform sampler2D t_picture;
void main() {
    vec3 linear = clamp(texture(t_picture, v_uv).rgb, 0.0, 1.0);
    vec3 curve = 1.055 * pow(linear, vec3(1.0 / 2.4)) - 0.055;
    o_color = vec4(mix(12.92 * linear, curve, greaterThan(linear, vec3(0.0031308))), 1.0);
}
)";

ShaderLibrary own_shaders() {
    ShaderLibrary library{""};
    library.add("present.vert.glsl", vertex_text);
    library.add("present.frag.glsl", fragment_text);
    return library;
}

}  // namespace

Presenter::Presenter(std::shared_ptr<Context> context)
    : context_{std::move(context)},
      program_{
          context_,
          own_shaders(),
          {{GL_VERTEX_SHADER, "present.vert.glsl"}, {GL_FRAGMENT_SHADER, "present.frag.glsl"}}},
      vertex_array_{context_} {}

void Presenter::draw(const float* rgba, int width, int height, int viewport_width,
                     int viewport_height) {
    const Context::Use use{*context_};
    if (picture_.width() != width || picture_.height() != height) {
        picture_ = Texture{context_, GL_TEXTURE_2D, GL_RGBA32F, width, height};
        picture_.set_filter(GL_LINEAR);
    }
    picture_.write(std::as_bytes(std::span{rgba, 4 * std::size_t(width) * std::size_t(height)}));
    const GladGLContext& gl = context_->gl();
    gl.BindFramebuffer(GL_FRAMEBUFFER, 0);
    gl.Viewport(0, 0, viewport_width, viewport_height);
    for (const GLenum off :
         {GL_BLEND, GL_DEPTH_TEST, GL_CULL_FACE, GL_SCISSOR_TEST, GL_FRAMEBUFFER_SRGB}) {
        gl.Disable(off);
    }
    gl.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    gl.ClipControl(GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
    gl.BindTextureUnit(*program_.sampler("t_picture"), picture_.name());
    gl.BindSampler(*program_.sampler("t_picture"), 0);
    program_.use();
    gl.BindVertexArray(vertex_array_.name());
    gl.DrawArrays(GL_TRIANGLES, 0, 3);
    check_errors(*context_, "presenting a picture");
}

}  // namespace opacity::gl
