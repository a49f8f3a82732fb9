// A renderer beside others: in a context that is not its own, in another thread, in another's way.
#include <doctest/doctest.h>
#include <glad/gl.h>

#include <algorithm>
#include <exception>
#include <optional>
#include <thread>

#include "gl/buffer.hpp"
#include "gl/egl.hpp"
#include "gl/object.hpp"
#include "gl/texture.hpp"
#include "gl_context.hpp"
#include "scratch_folder.hpp"
#include "small_renderer.hpp"

using namespace opacity;
using namespace small;

namespace {

using ContextPtr = std::shared_ptr<gl::Context>;

Image expected_picture() {
    return small_renderer(hairy_scene()).render();
}

// ---- the caller's OpenGL ----

constexpr GLenum scalars[] = {GL_ACTIVE_TEXTURE,
                              GL_ARRAY_BUFFER_BINDING,
                              GL_BLEND_COLOR,
                              GL_CLIP_DEPTH_MODE,
                              GL_CLIP_ORIGIN,
                              GL_COLOR_CLEAR_VALUE,
                              GL_COPY_READ_BUFFER_BINDING,
                              GL_CULL_FACE_MODE,
                              GL_CURRENT_PROGRAM,
                              GL_DEPTH_CLEAR_VALUE,
                              GL_DEPTH_FUNC,
                              GL_DEPTH_RANGE,
                              GL_DEPTH_WRITEMASK,
                              GL_DISPATCH_INDIRECT_BUFFER_BINDING,
                              GL_DRAW_FRAMEBUFFER_BINDING,
                              GL_FRONT_FACE,
                              GL_LINE_WIDTH,
                              GL_LOGIC_OP_MODE,
                              GL_PACK_ALIGNMENT,
                              GL_PACK_ROW_LENGTH,
                              GL_PACK_SKIP_ROWS,
                              GL_PACK_SWAP_BYTES,
                              GL_PIXEL_PACK_BUFFER_BINDING,
                              GL_PIXEL_UNPACK_BUFFER_BINDING,
                              GL_POLYGON_MODE,
                              GL_POLYGON_OFFSET_FACTOR,
                              GL_PRIMITIVE_RESTART_INDEX,
                              GL_PROGRAM_PIPELINE_BINDING,
                              GL_PROVOKING_VERTEX,
                              GL_READ_FRAMEBUFFER_BINDING,
                              GL_RENDERBUFFER_BINDING,
                              GL_SCISSOR_BOX,
                              GL_SHADER_STORAGE_BUFFER_BINDING,
                              GL_STENCIL_FUNC,
                              GL_STENCIL_REF,
                              GL_UNIFORM_BUFFER_BINDING,
                              GL_UNPACK_SKIP_PIXELS,
                              GL_UNPACK_ROW_LENGTH,
                              GL_VERTEX_ARRAY_BINDING,
                              GL_VIEWPORT};
constexpr GLenum switches[] = {GL_CLIP_DISTANCE0,     GL_COLOR_LOGIC_OP,      GL_CULL_FACE,
                               GL_DEPTH_TEST,         GL_POLYGON_OFFSET_FILL, GL_PRIMITIVE_RESTART,
                               GL_RASTERIZER_DISCARD, GL_SAMPLE_MASK,         GL_STENCIL_TEST};
constexpr GLenum indexed[] = {GL_BLEND_DST_ALPHA,
                              GL_BLEND_EQUATION_RGB,
                              GL_BLEND_SRC_RGB,
                              GL_COLOR_WRITEMASK,
                              GL_IMAGE_BINDING_ACCESS,
                              GL_IMAGE_BINDING_FORMAT,
                              GL_IMAGE_BINDING_LAYER,
                              GL_IMAGE_BINDING_NAME,
                              GL_SHADER_STORAGE_BUFFER_BINDING,
                              GL_SHADER_STORAGE_BUFFER_SIZE,
                              GL_SHADER_STORAGE_BUFFER_START};

// Everything that a caller can have set and a renderer can disturb.
std::vector<double> state_of(const GladGLContext& g) {
    std::vector<double> state;
    for (const GLenum name : scalars) {
        GLdouble values[4] = {};
        g.GetDoublev(name, values);
        state.insert(state.end(), values, values + 4);
    }
    for (const GLenum name : switches) state.push_back(g.IsEnabled(name));
    for (GLuint i = 0; i < 8; ++i) {
        for (const GLenum name : indexed) {
            GLint64 values[4] = {};
            g.GetInteger64i_v(name, i, values);
            state.insert(state.end(), values, values + 4);
        }
        state.push_back(g.IsEnabledi(GL_BLEND, i));
    }
    const GLint active = get(g, GL_ACTIVE_TEXTURE);
    for (GLuint unit = 0; unit < 16; ++unit) {
        g.ActiveTexture(GL_TEXTURE0 + unit);
        for (const GLenum name :
             {GL_TEXTURE_BINDING_2D, GL_TEXTURE_BINDING_2D_ARRAY, GL_SAMPLER_BINDING})
            state.push_back(get(g, name));
    }
    g.ActiveTexture(GLenum(active));
    return state;
}

// State in which nothing would be drawn, or something else, if any of it stayed.
struct HostileApplication {
    explicit HostileApplication(const ContextPtr& context)
        : texture{context, GL_TEXTURE_2D, GL_R32F, 4, 4},
          buffer{context, 4096},
          sampler{context},
          vertex_array{context},
          framebuffer{context} {
        bind(context->gl());
        for (const GLenum name : switches) context->gl().Enable(name);
        forbid_drawing(context->gl());
    }
    void bind(const GladGLContext& g) const {
        g.SamplerParameteri(sampler.name(), GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
        g.SamplerParameteri(sampler.name(), GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
        for (GLuint i = 0; i < 8; ++i) {
            g.BindTextureUnit(i, texture.name());
            g.BindSampler(i, sampler.name());
            g.BindBufferRange(GL_SHADER_STORAGE_BUFFER, i, buffer.name(), 256 * (i + 1), 256);
            g.BindImageTexture(i, texture.name(), 0, GL_FALSE, 0, GL_READ_ONLY, GL_R32F);
        }
        g.ActiveTexture(GL_TEXTURE5);
        for (const GLenum target : {GL_PIXEL_PACK_BUFFER, GL_PIXEL_UNPACK_BUFFER, GL_ARRAY_BUFFER,
                                    GL_DISPATCH_INDIRECT_BUFFER})
            g.BindBuffer(target, buffer.name());
        g.BindVertexArray(vertex_array.name());
        g.BindFramebuffer(GL_FRAMEBUFFER, framebuffer.name());
        for (const GLenum name : {GL_PACK_ROW_LENGTH, GL_UNPACK_ROW_LENGTH}) g.PixelStorei(name, 3);
        for (const GLenum name : {GL_PACK_SKIP_ROWS, GL_UNPACK_SKIP_PIXELS}) g.PixelStorei(name, 2);
        g.PixelStorei(GL_PACK_SWAP_BYTES, GL_TRUE);
        g.PixelStorei(GL_PACK_ALIGNMENT, 8);
    }
    static void forbid_drawing(const GladGLContext& g) {
        for (GLuint i = 0; i < 8; ++i) {
            g.Enablei(GL_BLEND, i);
            g.BlendFunci(i, GL_ZERO, GL_SRC_ALPHA);
            g.BlendEquationi(i, GL_MIN);
            g.ColorMaski(i, GL_FALSE, GL_TRUE, GL_FALSE, GL_FALSE);
        }
        g.SampleMaski(0, 0);
        g.StencilFunc(GL_NEVER, 1, 255);
        g.LogicOp(GL_INVERT);
        g.DepthFunc(GL_NEVER);
        g.DepthMask(GL_FALSE);
        g.DepthRange(0.75, 0.25);
        g.PolygonMode(GL_FRONT_AND_BACK, GL_POINT);
        g.PolygonOffset(1000.f, 1000.f);
        g.CullFace(GL_FRONT_AND_BACK);
        g.PrimitiveRestartIndex(2);
        g.ProvokingVertex(GL_FIRST_VERTEX_CONVENTION);
        g.ClipControl(GL_UPPER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
        g.Viewport(1, 2, 3, 4);
        g.Scissor(5, 6, 1, 1);
        g.Enable(GL_SCISSOR_TEST);
        g.ClearColor(1.f, 0.f, 1.f, 1.f);
    }

    gl::Texture texture;
    gl::Buffer buffer;
    gl::Sampler sampler;
    gl::VertexArray vertex_array;
    gl::Framebuffer framebuffer;
};

// The objects that OpenGL itself knows of. A program that was deleted while it was current goes
// when the driver puts another in its place.
int objects_in(const GladGLContext& g) {
    int count = 0;
    for (GLuint name = 1; name < 5000; ++name) {
        count += g.IsTexture(name) + g.IsBuffer(name) + g.IsFramebuffer(name) +
                 g.IsVertexArray(name) + g.IsSampler(name) + g.IsShader(name);
        GLint deleted = GL_TRUE;
        if (g.IsProgram(name)) g.GetProgramiv(name, GL_DELETE_STATUS, &deleted);
        count += deleted == GL_FALSE;
    }
    return count;
}

// Runs `work` on a thread of its own, and throws what it throws.
template <class Work>
void on_another_thread(Work work) {
    std::exception_ptr thrown;
    std::thread{[&] {
        try {
            work();
        } catch (...) {
            thrown = std::current_exception();
        }
    }}.join();
    if (thrown) std::rethrow_exception(thrown);
}

}  // namespace

TEST_CASE("in the caller's context, a renderer draws the same bits and leaves no trace") {
    const auto owner = context_or_skip();
    if (!owner) return;
    const Image expected = expected_picture();
    const gl::Context::Use owners_use{*owner};
    const HostileApplication application{owner};
    const auto adopted = gl::Context::adopt(gl::Egl::open().GetProcAddress);
    const std::vector<double> before = state_of(owner->gl());
    const int objects_before = objects_in(owner->gl());
    {
        Renderer renderer = small_renderer(hairy_scene(), adopted);
        CHECK(same(renderer.render(), expected));
        CHECK(state_of(owner->gl()) == before);
        CHECK(objects_in(owner->gl()) > objects_before);
        CHECK(adopted->live_objects() == objects_in(owner->gl()) - objects_before);
        renderer.settings().antialiasing.assign(std::int64_t{2});
        renderer.set_technique(make_technique("exact"));
        renderer.render();
        renderer.transmittance(Positions{std::vector<double>{0, 0, 1}});
        renderer.read("opaque_depth");
        CHECK(state_of(owner->gl()) == before);
    }
    CHECK(adopted->live_objects() == 0);
    CHECK(objects_in(owner->gl()) == objects_before);
    CHECK(state_of(owner->gl()) == before);
    CHECK(owner->gl().GetError() == GL_NO_ERROR);
}

TEST_CASE("a frame that fails gives the caller's state back too") {
    const auto owner = context_or_skip();
    if (!owner) return;
    const gl::Context::Use owners_use{*owner};
    const HostileApplication application{owner};
    const auto adopted = gl::Context::adopt(gl::Egl::open().GetProcAddress);
    const std::vector<double> before = state_of(owner->gl());
    Renderer renderer = small_renderer(hairy_scene(), adopted);
    int passes = 0;
    renderer.set_interrupt_check([&] {
        if (++passes == 3) throw ParameterError("stop", "go on");
    });
    CHECK_THROWS_AS(renderer.render(), ParameterError);
    CHECK(state_of(owner->gl()) == before);
    CHECK(same(renderer.render(), expected_picture()));
}

TEST_CASE("a renderer needs its adopted context current, from the first call on") {
    const auto owner = context_or_skip();
    if (!owner) return;
    ContextPtr adopted;
    {
        const gl::Context::Use use{*owner};
        adopted = gl::Context::adopt(gl::Egl::open().GetProcAddress);
    }
    CHECK_THROWS_AS(small_renderer(hairy_scene(), adopted), ContextError);
    std::optional<Renderer> renderer;
    {
        const gl::Context::Use use{*owner};
        renderer.emplace(small_renderer(hairy_scene(), adopted));
        renderer->render();
    }
    CHECK_THROWS_AS(renderer->render(), ContextError);
    renderer.reset();
    const gl::Context::Use owners_use{*owner};
    { const gl::Context::Use use{*adopted}; }  // frees what waited for it
    CHECK(adopted->live_objects() == 0);
    CHECK(objects_in(owner->gl()) == 0);
}

TEST_CASE("renderers free every object, on whichever thread they end") {
    const auto context = context_or_skip();
    if (!context) return;
    const auto objects = [&] {
        const gl::Context::Use use{*context};
        return objects_in(context->gl());
    };
    for (const std::string& technique : technique_names()) {
        CAPTURE(technique);
        auto renderer = std::make_unique<Renderer>(
            small_renderer(hairy_scene(), context, make_technique(technique)));
        renderer->render();
        renderer->transmittance(Positions{std::vector<double>{0, 0, 1}});
        CHECK(context->live_objects() == objects());
        if (technique == "exact")
            on_another_thread([&] { renderer.reset(); });
        else
            renderer.reset();
        CHECK(context->live_objects() == 0);
        CHECK(objects() == 0);
    }
}

TEST_CASE("a renderer refuses every other thread, and goes on with its own") {
    if (!context_or_skip()) return;
    Renderer renderer = small_renderer(hairy_scene());
    const Image first = renderer.render();
    const Positions points{std::vector<double>{0, 0, 1}};
    const auto refused = [](const auto& call) {
        return message_of<ContextError>([&] { on_another_thread(call); });
    };
    CHECK(contains(refused([&] { renderer.render(); }), "thread"));
    CHECK(contains(refused([&] { renderer.transmittance(points); }), "thread"));
    CHECK(contains(refused([&] { renderer.read("opaque_depth"); }), "thread"));
    CHECK(contains(refused([&] { renderer.context().limits(); }), "thread"));
    CHECK(same(renderer.render(), first));
    renderer.invalidate();
    CHECK(same(renderer.render(), first));
}

TEST_CASE("two renderers in two threads draw one scene with the same bits") {
    if (!context_or_skip()) return;
    const auto scene = hairy_scene();
    const Image expected = small_renderer(scene).render();
    std::vector<Image> pictures(8);
    std::vector<std::thread> threads;
    for (std::size_t first : {0u, 4u})
        threads.emplace_back([&pictures, &scene, first] {
            Renderer renderer = small_renderer(scene);
            for (std::size_t i = first; i < first + 4; ++i) {
                renderer.invalidate();
                pictures[i] = renderer.render();
            }
        });
    for (std::thread& thread : threads) thread.join();
    for (const Image& picture : pictures) CHECK(same(picture, expected));
}

TEST_CASE("two renderers share a context without a trace of each other") {
    const auto context = context_or_skip();
    if (!context) return;
    Renderer first = small_renderer(hairy_scene(), context);
    Renderer second = small_renderer(hairy_scene(), context, make_technique("exact"));
    const Image picture = first.render(), exact = second.render();
    for (int frame = 0; frame < 2; ++frame) {
        first.invalidate();
        second.invalidate();
        CHECK(same(first.render(), picture));
        CHECK(same(second.render(), exact));
    }
    CHECK(same(picture, expected_picture()));
}
