// The renderer: the picture it must be, whatever context it has and whatever happened before.
#include "opacity/renderer.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <numbers>
#include <optional>
#include <thread>

#include "gl/egl.hpp"
#include "gl_context.hpp"
#include "opacity/scene/mesh.hpp"
#include "opacity/scene/strands.hpp"
#include "scratch_folder.hpp"

using namespace opacity;
using doctest::Approx;

namespace {

using ContextPtr = std::shared_ptr<gl::Context>;
using ScenePtr = std::shared_ptr<Scene>;

// ---- scenes ----

std::shared_ptr<Mesh> square(double height, double half_size, float opacity, float3 color) {
    const double s = half_size, z = height;
    return std::make_shared<Mesh>(
        Positions{std::vector<double>{-s, -s, z, s, -s, z, s, s, z, -s, s, z}},
        std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3}, std::vector<float3>{},
        std::vector<float>{opacity}, std::vector<float3>{color});
}

ScenePtr scene_of(std::vector<ShapePtr> shapes, const DirectionalLight& light) {
    auto scene = std::make_shared<Scene>();
    for (ShapePtr& shape : shapes) scene->add(std::move(shape));
    scene->add(std::make_shared<DirectionalLight>(light));
    return scene;
}

// Strands and an opaque square above an opaque ground.
ScenePtr hairy_scene() {
    std::vector<double> xyz;
    std::vector<std::int64_t> offsets{0};
    for (int strand = 0; strand < 9; ++strand) {
        for (int i = 0; i < 4; ++i)
            xyz.insert(xyz.end(),
                       {0.25 * strand - 1.0, 0.3 * i - 0.5, 0.3 + 0.1 * i + 0.05 * (strand % 3)});
        offsets.push_back(offsets.back() + 4);
    }
    auto hair = std::make_shared<Strands>(Positions{xyz}, offsets, std::vector<float>{0.15f});
    return scene_of({hair, square(0.2, 0.3, 1.f, {0, 1, 0}), square(0, 1.5, 1.f, {1, 1, 1})},
                    DirectionalLight{});
}

Camera above() { return Camera::look_at({0.4, -2.0, 3.0}, {0, 0, 0}); }

void make_small(Renderer& renderer) {
    renderer.set_size(40, 30);
    renderer.settings().map_size.assign(std::int64_t{32});
    renderer.settings().antialiasing.assign(std::int64_t{1});
}

Renderer small_renderer(const ScenePtr& scene, const ContextPtr& context = {},
                        std::shared_ptr<Technique> technique = {}) {
    Renderer renderer{scene, above(), std::move(technique), context};
    make_small(renderer);
    return renderer;
}

bool same(const Image& a, const Image& b) {
    return a.width == b.width && a.height == b.height && a.rgba.size() == b.rgba.size() &&
           std::memcmp(a.rgba.data(), b.rgba.data(), a.rgba.size() * sizeof(float)) == 0;
}

Image expected_picture() { return small_renderer(hairy_scene()).render(); }

// ---- the caller's OpenGL ----

constexpr GLenum scalars[] = {
    GL_ACTIVE_TEXTURE, GL_ARRAY_BUFFER_BINDING, GL_BLEND_COLOR, GL_CLIP_DEPTH_MODE, GL_CLIP_ORIGIN,
    GL_COLOR_CLEAR_VALUE, GL_COPY_READ_BUFFER_BINDING, GL_CULL_FACE_MODE, GL_CURRENT_PROGRAM,
    GL_DEPTH_CLEAR_VALUE, GL_DEPTH_FUNC, GL_DEPTH_RANGE, GL_DEPTH_WRITEMASK,
    GL_DISPATCH_INDIRECT_BUFFER_BINDING, GL_DRAW_FRAMEBUFFER_BINDING, GL_FRONT_FACE, GL_LINE_WIDTH,
    GL_LOGIC_OP_MODE, GL_PACK_ALIGNMENT, GL_PACK_ROW_LENGTH, GL_PACK_SKIP_ROWS, GL_PACK_SWAP_BYTES,
    GL_PIXEL_PACK_BUFFER_BINDING, GL_PIXEL_UNPACK_BUFFER_BINDING, GL_POLYGON_MODE,
    GL_POLYGON_OFFSET_FACTOR, GL_PRIMITIVE_RESTART_INDEX, GL_PROGRAM_PIPELINE_BINDING,
    GL_PROVOKING_VERTEX, GL_READ_FRAMEBUFFER_BINDING, GL_RENDERBUFFER_BINDING, GL_SCISSOR_BOX,
    GL_SHADER_STORAGE_BUFFER_BINDING, GL_STENCIL_FUNC, GL_STENCIL_REF, GL_UNIFORM_BUFFER_BINDING,
    GL_UNPACK_SKIP_PIXELS, GL_UNPACK_ROW_LENGTH, GL_VERTEX_ARRAY_BINDING, GL_VIEWPORT};
constexpr GLenum switches[] = {GL_CLIP_DISTANCE0, GL_COLOR_LOGIC_OP, GL_CULL_FACE, GL_DEPTH_TEST,
                               GL_POLYGON_OFFSET_FILL, GL_PRIMITIVE_RESTART,
                               GL_RASTERIZER_DISCARD, GL_SAMPLE_MASK, GL_STENCIL_TEST};
constexpr GLenum indexed[] = {GL_BLEND_DST_ALPHA, GL_BLEND_EQUATION_RGB, GL_BLEND_SRC_RGB,
                              GL_COLOR_WRITEMASK, GL_IMAGE_BINDING_ACCESS, GL_IMAGE_BINDING_FORMAT,
                              GL_IMAGE_BINDING_LAYER, GL_IMAGE_BINDING_NAME,
                              GL_SHADER_STORAGE_BUFFER_BINDING, GL_SHADER_STORAGE_BUFFER_SIZE,
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

// The objects that OpenGL itself knows of.
int objects_in(const GladGLContext& g) {
    int count = 0;
    for (GLuint name = 1; name < 5000; ++name)
        count += g.IsTexture(name) + g.IsBuffer(name) + g.IsProgram(name) + g.IsShader(name) +
                 g.IsFramebuffer(name) + g.IsVertexArray(name) + g.IsSampler(name);
    return count;
}

// ---- techniques that declare too little ----

// Bounding opacity maps whose look-up lacks one of its reads.
class Forgetful : public Technique {
   public:
    explicit Forgetful(std::string forgotten)
        : Technique{"bounding_opacity_maps"}, forgotten_{std::move(forgotten)} {}
    std::string_view summary() const override { return "Forgets a read."; }
    std::string_view paper() const override { return "none"; }
    Reads build(FrameGraph& graph, const ShadowInputs& inputs) override {
        Reads reads = complete_->build(graph, inputs);
        const auto forgotten = [this](const Source* read) {
            return read->name().substr(read->name().rfind('/') + 1) == forgotten_;
        };
        REQUIRE(std::erase_if(reads, forgotten) == 1);
        return reads;
    }

   private:
    std::string forgotten_;
    std::unique_ptr<Technique> complete_ = make_technique("bounding_opacity_maps");
};

// A pass that draws with opacities and planes without declaring that it reads them.
class Careless : public Technique {
   public:
    Careless() : Technique{"bounding_opacity_maps"} {}
    std::string_view summary() const override { return "Declares nothing."; }
    std::string_view paper() const override { return "none"; }
    Reads build(FrameGraph& graph, const ShadowInputs& inputs) override {
        Texture& opacity = graph.texture("opacity", inputs.map(Format::rgba32f, 1));
        const Defines defines{{"PASS_opacity", "1"}, {"TARGETS", "1"}, {"FIRST_TARGET", "0"}};
        graph.add({.name = "deposit",
                   .shader = inputs.caster_shader(shader_path(), true, defines),
                   .draws = &inputs.translucent,
                   .view = &inputs.light,
                   .writes = {&opacity}});
        return {&opacity};
    }
};
