// A context that the caller made: we need it current, and it gets its state back.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>

#include "gl/buffer.hpp"
#include "gl/egl.hpp"
#include "gl/object.hpp"
#include "gl/texture.hpp"
#include "gl_context.hpp"
#include "opacity/core/error.hpp"

namespace gl = opacity::gl;

namespace {

// State as an application may have it, different from the defaults in everything.
struct Application {
    explicit Application(const std::shared_ptr<gl::Context>& context)
        : texture{context, GL_TEXTURE_2D, GL_R32F, 4, 4},
          buffer{context, 1024},
          sampler{context},
          vertex_array{context},
          framebuffer{context} {}

    gl::Texture texture;
    gl::Buffer buffer;
    gl::Sampler sampler;
    gl::VertexArray vertex_array;
    gl::Framebuffer framebuffer;

    void set_bindings(const GladGLContext& g) const {
        g.BindTextureUnit(7, texture.name());
        g.BindSampler(7, sampler.name());
        g.ActiveTexture(GL_TEXTURE3);
        g.BindVertexArray(vertex_array.name());
        g.BindFramebuffer(GL_FRAMEBUFFER, framebuffer.name());
        g.BindBufferRange(GL_SHADER_STORAGE_BUFFER, 5, buffer.name(), 256, 512);
        g.BindBuffer(GL_PIXEL_UNPACK_BUFFER, buffer.name());
        g.BindImageTexture(2, texture.name(), 0, GL_FALSE, 0, GL_READ_ONLY, GL_R32F);
        g.PixelStorei(GL_UNPACK_ROW_LENGTH, 17);
    }
    static void set_drawing(const GladGLContext& g) {
        g.Viewport(1, 2, 3, 4);
        g.Scissor(5, 6, 7, 8);
        g.Enable(GL_SCISSOR_TEST);
        g.Enablei(GL_BLEND, 1);
        g.BlendFunci(1, GL_SRC_ALPHA, GL_ONE);
        g.BlendEquationi(1, GL_MAX);
        g.ColorMaski(1, GL_TRUE, GL_FALSE, GL_TRUE, GL_FALSE);
        g.DepthFunc(GL_GEQUAL);
        g.DepthMask(GL_FALSE);
        g.ClipControl(GL_UPPER_LEFT, GL_ZERO_TO_ONE);
        g.PolygonOffset(2.f, 3.f);
        g.Enable(GL_CULL_FACE);
        g.CullFace(GL_FRONT);
    }
    void check_bindings(const GladGLContext& g) const {
        CHECK(get(g, GL_ACTIVE_TEXTURE) == GL_TEXTURE3);
        CHECK(get(g, GL_VERTEX_ARRAY_BINDING) == GLint(vertex_array.name()));
        CHECK(get(g, GL_DRAW_FRAMEBUFFER_BINDING) == GLint(framebuffer.name()));
        CHECK(get(g, GL_PIXEL_UNPACK_BUFFER_BINDING) == GLint(buffer.name()));
        CHECK(get(g, GL_UNPACK_ROW_LENGTH) == 17);
        CHECK(get(g, GL_SHADER_STORAGE_BUFFER_BINDING, 5) == GLint(buffer.name()));
        GLint64 start = 0;
        g.GetInteger64i_v(GL_SHADER_STORAGE_BUFFER_START, 5, &start);
        CHECK(start == 256);
        CHECK(get(g, GL_IMAGE_BINDING_NAME, 2) == GLint(texture.name()));
        CHECK(get(g, GL_IMAGE_BINDING_ACCESS, 2) == GL_READ_ONLY);
        g.ActiveTexture(GL_TEXTURE7);
        CHECK(get(g, GL_TEXTURE_BINDING_2D) == GLint(texture.name()));
        CHECK(get(g, GL_SAMPLER_BINDING) == GLint(sampler.name()));
    }
    static void check_drawing(const GladGLContext& g) {
        std::array<GLint, 4> viewport, scissor;
        std::array<GLboolean, 4> mask;
        g.GetIntegerv(GL_VIEWPORT, viewport.data());
        g.GetIntegerv(GL_SCISSOR_BOX, scissor.data());
        g.GetBooleani_v(GL_COLOR_WRITEMASK, 1, mask.data());
        CHECK(viewport == std::array{1, 2, 3, 4});
        CHECK(scissor == std::array{5, 6, 7, 8});
        CHECK(mask == std::array<GLboolean, 4>{GL_TRUE, GL_FALSE, GL_TRUE, GL_FALSE});
        CHECK(g.IsEnabled(GL_SCISSOR_TEST));
        CHECK(g.IsEnabledi(GL_BLEND, 1));
        CHECK_FALSE(g.IsEnabledi(GL_BLEND, 0));
        CHECK(get(g, GL_BLEND_SRC_RGB, 1) == GL_SRC_ALPHA);
        CHECK(get(g, GL_BLEND_EQUATION_RGB, 1) == GL_MAX);
        CHECK(get(g, GL_DEPTH_FUNC) == GL_GEQUAL);
        CHECK(get(g, GL_DEPTH_WRITEMASK) == GL_FALSE);
        CHECK(get(g, GL_CLIP_ORIGIN) == GL_UPPER_LEFT);
        CHECK(get(g, GL_POLYGON_OFFSET_FACTOR) == 2);
        CHECK(g.IsEnabled(GL_CULL_FACE));
        CHECK(get(g, GL_CULL_FACE_MODE) == GL_FRONT);
    }
};

void check_defaults(const GladGLContext& g) {
    CHECK(get(g, GL_PIXEL_UNPACK_BUFFER_BINDING) == 0);
    CHECK(get(g, GL_UNPACK_ROW_LENGTH) == 0);
    CHECK(get(g, GL_DEPTH_WRITEMASK) == GL_TRUE);
    CHECK_FALSE(g.IsEnabledi(GL_BLEND, 1));
    CHECK_FALSE(g.IsEnabled(GL_SCISSOR_TEST));
}

// What a renderer would do to the state.
void render(const std::shared_ptr<gl::Context>& context) {
    const gl::Context::Use nested{*context};
    const GladGLContext& g = context->gl();
    const gl::Texture texture{context, GL_TEXTURE_2D, GL_RGBA32F, 2, 2};
    const gl::Framebuffer framebuffer{context};
    for (GLuint unit = 0; unit < 8; ++unit) g.BindTextureUnit(unit, texture.name());
    g.BindFramebuffer(GL_FRAMEBUFFER, framebuffer.name());
    g.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 5, 0);
    g.BindImageTexture(2, texture.name(), 0, GL_TRUE, 0, GL_WRITE_ONLY, GL_RGBA32F);
    g.Viewport(0, 0, 100, 100);
    g.Scissor(0, 0, 100, 100);
    g.Enable(GL_BLEND);
    g.BlendFunc(GL_ONE, GL_ONE);
    g.DepthFunc(GL_ALWAYS);
    g.ClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
}

}  // namespace

TEST_CASE("an adopted context gets its state back") {
    const auto owner = context_or_skip();
    if (!owner) return;
    const gl::Context::Use owners_use{*owner};
    const auto adopted = gl::Context::adopt(gl::Egl::open().GetProcAddress);
    CHECK(adopted->adopted());
    const Application application{owner};
    application.set_bindings(owner->gl());
    application.set_drawing(owner->gl());
    {
        const gl::Context::Use use{*adopted};
        check_defaults(adopted->gl());
        render(adopted);
    }
    CHECK(adopted->live_objects() == 0);
    application.check_bindings(owner->gl());
    application.check_drawing(owner->gl());
    CHECK(owner->gl().GetError() == GL_NO_ERROR);
}

TEST_CASE("adopting needs a current context, then and later") {
    const auto owner = context_or_skip();
    if (!owner) return;
    const auto loader = gl::Egl::open().GetProcAddress;
    CHECK_THROWS_AS(gl::Context::adopt(loader), opacity::ContextError);
    CHECK_THROWS_AS(gl::Context::adopt(nullptr), opacity::ParameterError);
    std::shared_ptr<gl::Context> adopted;
    {
        const gl::Context::Use use{*owner};
        adopted = gl::Context::adopt(loader);
    }
    CHECK_THROWS_WITH_AS(gl::Context::Use{*adopted}, doctest::Contains("not current"),
                         opacity::ContextError);
    const auto other = gl::Context::headless();
    const gl::Context::Use use{*other};
    CHECK_THROWS_AS(gl::Context::Use{*adopted}, opacity::ContextError);
}
