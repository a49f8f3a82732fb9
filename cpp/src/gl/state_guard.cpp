#include "gl/state_guard.hpp"

#include <glad/gl.h>

#include <algorithm>
#include <array>
#include <tuple>
#include <vector>

namespace opacity::gl {
namespace {

constexpr int texture_units = 32, storage_buffers = 16, image_units = 8;

GLint get(const GladGLContext& gl, GLenum name) {
    GLint value = 0;
    gl.GetIntegerv(name, &value);
    return value;
}

GLint get(const GladGLContext& gl, GLenum name, GLuint index) {
    GLint value = 0;
    gl.GetIntegeri_v(name, index, &value);
    return value;
}

int at_most(const GladGLContext& gl, GLenum limit, int wanted) {
    return std::min(wanted, get(gl, limit));
}

void enable(const GladGLContext& gl, GLenum capability, bool on) {
    on ? gl.Enable(capability) : gl.Disable(capability);
}

void enable(const GladGLContext& gl, GLenum capability, GLuint index, bool on) {
    on ? gl.Enablei(capability, index) : gl.Disablei(capability, index);
}

// ---- switches ----

constexpr std::array switches = {GL_DEPTH_TEST,
                                 GL_STENCIL_TEST,
                                 GL_CULL_FACE,
                                 GL_DEPTH_CLAMP,
                                 GL_POLYGON_OFFSET_FILL,
                                 GL_POLYGON_OFFSET_LINE,
                                 GL_POLYGON_OFFSET_POINT,
                                 GL_POLYGON_SMOOTH,
                                 GL_LINE_SMOOTH,
                                 GL_COLOR_LOGIC_OP,
                                 GL_FRAMEBUFFER_SRGB,
                                 GL_DITHER,
                                 GL_MULTISAMPLE,
                                 GL_SAMPLE_ALPHA_TO_COVERAGE,
                                 GL_SAMPLE_ALPHA_TO_ONE,
                                 GL_SAMPLE_COVERAGE,
                                 GL_SAMPLE_MASK,
                                 GL_SAMPLE_SHADING,
                                 GL_PRIMITIVE_RESTART,
                                 GL_PRIMITIVE_RESTART_FIXED_INDEX,
                                 GL_RASTERIZER_DISCARD,
                                 GL_PROGRAM_POINT_SIZE,
                                 GL_CLIP_DISTANCE0,
                                 GL_CLIP_DISTANCE1,
                                 GL_CLIP_DISTANCE2,
                                 GL_CLIP_DISTANCE3,
                                 GL_CLIP_DISTANCE4,
                                 GL_CLIP_DISTANCE5,
                                 GL_CLIP_DISTANCE6,
                                 GL_CLIP_DISTANCE7};

struct Switches {
    std::array<bool, switches.size()> on{};

    void save(const GladGLContext& gl) {
        for (std::size_t i = 0; i < switches.size(); ++i) on[i] = gl.IsEnabled(switches[i]);
    }
    void restore(const GladGLContext& gl) const {
        for (std::size_t i = 0; i < switches.size(); ++i) enable(gl, switches[i], on[i]);
    }
};

// ---- what happens to fragments ----

struct DrawBuffer {
    GLboolean blend, color_mask[4];
    GLint source_rgb, target_rgb, source_alpha, target_alpha, equation_rgb, equation_alpha;

    void save(const GladGLContext& gl, GLuint i) {
        blend = gl.IsEnabledi(GL_BLEND, i);
        gl.GetBooleani_v(GL_COLOR_WRITEMASK, i, color_mask);
        source_rgb = get(gl, GL_BLEND_SRC_RGB, i);
        target_rgb = get(gl, GL_BLEND_DST_RGB, i);
        source_alpha = get(gl, GL_BLEND_SRC_ALPHA, i);
        target_alpha = get(gl, GL_BLEND_DST_ALPHA, i);
        equation_rgb = get(gl, GL_BLEND_EQUATION_RGB, i);
        equation_alpha = get(gl, GL_BLEND_EQUATION_ALPHA, i);
    }
    void restore(const GladGLContext& gl, GLuint i) const {
        enable(gl, GL_BLEND, i, blend);
        gl.ColorMaski(i, color_mask[0], color_mask[1], color_mask[2], color_mask[3]);
        gl.BlendFuncSeparatei(i, source_rgb, target_rgb, source_alpha, target_alpha);
        gl.BlendEquationSeparatei(i, equation_rgb, equation_alpha);
    }
};

struct Fragments {
    std::vector<DrawBuffer> draw_buffers;
    GLfloat blend_color[4], clear_color[4], clear_depth;
    GLboolean depth_mask;
    GLint depth_func;

    void save(const GladGLContext& gl) {
        draw_buffers.resize(get(gl, GL_MAX_DRAW_BUFFERS));
        for (GLuint i = 0; i < draw_buffers.size(); ++i) draw_buffers[i].save(gl, i);
        gl.GetFloatv(GL_BLEND_COLOR, blend_color);
        gl.GetFloatv(GL_COLOR_CLEAR_VALUE, clear_color);
        gl.GetFloatv(GL_DEPTH_CLEAR_VALUE, &clear_depth);
        gl.GetBooleanv(GL_DEPTH_WRITEMASK, &depth_mask);
        depth_func = get(gl, GL_DEPTH_FUNC);
    }
    void restore(const GladGLContext& gl) const {
        for (GLuint i = 0; i < draw_buffers.size(); ++i) draw_buffers[i].restore(gl, i);
        gl.BlendColor(blend_color[0], blend_color[1], blend_color[2], blend_color[3]);
        gl.ClearColor(clear_color[0], clear_color[1], clear_color[2], clear_color[3]);
        gl.ClearDepthf(clear_depth);
        gl.DepthMask(depth_mask);
        gl.DepthFunc(depth_func);
    }
};

// ---- how primitives become fragments ----

struct Viewport {
    GLfloat rectangle[4];
    GLdouble depth_range[2];
    GLint scissor[4];
    GLboolean scissor_test;
};

struct Rasterization {
    std::vector<Viewport> viewports;  // glViewport and glScissor set all of them
    GLfloat offset_factor, offset_units, line_width, point_size;
    GLint cull_face, front_face, polygon_mode, clip_origin, clip_depth, provoking_vertex,
        restart_index;

    void save(const GladGLContext& gl) {
        viewports.resize(get(gl, GL_MAX_VIEWPORTS));
        for (GLuint i = 0; i < viewports.size(); ++i) {
            gl.GetFloati_v(GL_VIEWPORT, i, viewports[i].rectangle);
            gl.GetDoublei_v(GL_DEPTH_RANGE, i, viewports[i].depth_range);
            gl.GetIntegeri_v(GL_SCISSOR_BOX, i, viewports[i].scissor);
            viewports[i].scissor_test = gl.IsEnabledi(GL_SCISSOR_TEST, i);
        }
        gl.GetFloatv(GL_POLYGON_OFFSET_FACTOR, &offset_factor);
        gl.GetFloatv(GL_POLYGON_OFFSET_UNITS, &offset_units);
        gl.GetFloatv(GL_LINE_WIDTH, &line_width);
        gl.GetFloatv(GL_POINT_SIZE, &point_size);
        cull_face = get(gl, GL_CULL_FACE_MODE);
        front_face = get(gl, GL_FRONT_FACE);
        GLint modes[2] = {GL_FILL, GL_FILL};  // some drivers answer for front and back
        gl.GetIntegerv(GL_POLYGON_MODE, modes);
        polygon_mode = modes[0];
        clip_origin = get(gl, GL_CLIP_ORIGIN);
        clip_depth = get(gl, GL_CLIP_DEPTH_MODE);
        provoking_vertex = get(gl, GL_PROVOKING_VERTEX);
        restart_index = get(gl, GL_PRIMITIVE_RESTART_INDEX);
    }
    void restore(const GladGLContext& gl) const {
        for (GLuint i = 0; i < viewports.size(); ++i) {
            gl.ViewportIndexedfv(i, viewports[i].rectangle);
            gl.DepthRangeIndexed(i, viewports[i].depth_range[0], viewports[i].depth_range[1]);
            gl.ScissorIndexedv(i, viewports[i].scissor);
            enable(gl, GL_SCISSOR_TEST, i, viewports[i].scissor_test);
        }
        gl.PolygonOffset(offset_factor, offset_units);
        gl.LineWidth(line_width);
        gl.PointSize(point_size);
        gl.CullFace(cull_face);
        gl.FrontFace(front_face);
        gl.PolygonMode(GL_FRONT_AND_BACK, polygon_mode);
        gl.ClipControl(clip_origin, clip_depth);
        gl.ProvokingVertex(provoking_vertex);
        gl.PrimitiveRestartIndex(restart_index);
    }
};

// ---- what is bound ----

struct Target {
    GLenum target, binding;
};
constexpr std::array<Target, 11> texture_targets = {{
    {GL_TEXTURE_1D, GL_TEXTURE_BINDING_1D},
    {GL_TEXTURE_2D, GL_TEXTURE_BINDING_2D},
    {GL_TEXTURE_3D, GL_TEXTURE_BINDING_3D},
    {GL_TEXTURE_1D_ARRAY, GL_TEXTURE_BINDING_1D_ARRAY},
    {GL_TEXTURE_2D_ARRAY, GL_TEXTURE_BINDING_2D_ARRAY},
    {GL_TEXTURE_RECTANGLE, GL_TEXTURE_BINDING_RECTANGLE},
    {GL_TEXTURE_BUFFER, GL_TEXTURE_BINDING_BUFFER},
    {GL_TEXTURE_CUBE_MAP, GL_TEXTURE_BINDING_CUBE_MAP},
    {GL_TEXTURE_CUBE_MAP_ARRAY, GL_TEXTURE_BINDING_CUBE_MAP_ARRAY},
    {GL_TEXTURE_2D_MULTISAMPLE, GL_TEXTURE_BINDING_2D_MULTISAMPLE},
    {GL_TEXTURE_2D_MULTISAMPLE_ARRAY, GL_TEXTURE_BINDING_2D_MULTISAMPLE_ARRAY},
}};
constexpr std::array<Target, 8> buffer_targets = {{
    {GL_ARRAY_BUFFER, GL_ARRAY_BUFFER_BINDING},
    {GL_COPY_READ_BUFFER, GL_COPY_READ_BUFFER_BINDING},
    {GL_COPY_WRITE_BUFFER, GL_COPY_WRITE_BUFFER_BINDING},
    {GL_PIXEL_PACK_BUFFER, GL_PIXEL_PACK_BUFFER_BINDING},
    {GL_PIXEL_UNPACK_BUFFER, GL_PIXEL_UNPACK_BUFFER_BINDING},
    {GL_UNIFORM_BUFFER, GL_UNIFORM_BUFFER_BINDING},
    {GL_DRAW_INDIRECT_BUFFER, GL_DRAW_INDIRECT_BUFFER_BINDING},
    {GL_DISPATCH_INDIRECT_BUFFER, GL_DISPATCH_INDIRECT_BUFFER_BINDING},
}};

struct TextureUnits {
    struct Unit {
        std::array<GLint, texture_targets.size()> textures;
        GLint sampler;
    };
    std::vector<Unit> units;
    GLint active;

    void save(const GladGLContext& gl) {
        active = get(gl, GL_ACTIVE_TEXTURE);
        units.resize(at_most(gl, GL_MAX_COMBINED_TEXTURE_IMAGE_UNITS, texture_units));
        for (GLuint i = 0; i < units.size(); ++i) {
            gl.ActiveTexture(GL_TEXTURE0 + i);
            units[i].sampler = get(gl, GL_SAMPLER_BINDING);
            for (std::size_t t = 0; t < texture_targets.size(); ++t) {
                units[i].textures[t] = get(gl, texture_targets[t].binding);
            }
        }
    }
    void restore(const GladGLContext& gl) const {
        for (GLuint i = 0; i < units.size(); ++i) {
            gl.ActiveTexture(GL_TEXTURE0 + i);
            gl.BindSampler(i, units[i].sampler);
            for (std::size_t t = 0; t < texture_targets.size(); ++t) {
                gl.BindTexture(texture_targets[t].target, units[i].textures[t]);
            }
        }
        gl.ActiveTexture(active);
    }
};

struct Images {
    struct Unit {
        GLint texture, level, layered, layer, access, format;
    };
    std::vector<Unit> units;

    void save(const GladGLContext& gl) {
        units.resize(at_most(gl, GL_MAX_IMAGE_UNITS, image_units));
        for (GLuint i = 0; i < units.size(); ++i) {
            units[i] = {get(gl, GL_IMAGE_BINDING_NAME, i),    get(gl, GL_IMAGE_BINDING_LEVEL, i),
                        get(gl, GL_IMAGE_BINDING_LAYERED, i), get(gl, GL_IMAGE_BINDING_LAYER, i),
                        get(gl, GL_IMAGE_BINDING_ACCESS, i),  get(gl, GL_IMAGE_BINDING_FORMAT, i)};
        }
    }
    void restore(const GladGLContext& gl) const {
        for (GLuint i = 0; i < units.size(); ++i) {
            const Unit& u = units[i];
            gl.BindImageTexture(i, u.texture, u.level, GLboolean(u.layered), u.layer, u.access,
                                u.format);
        }
    }
};

struct Buffers {
    struct Range {
        GLint buffer;
        GLint64 start, size;
    };
    std::vector<Range> storage;
    GLint generic_storage;
    std::array<GLint, buffer_targets.size()> bound;

    void save(const GladGLContext& gl) {
        generic_storage = get(gl, GL_SHADER_STORAGE_BUFFER_BINDING);
        storage.resize(at_most(gl, GL_MAX_SHADER_STORAGE_BUFFER_BINDINGS, storage_buffers));
        for (GLuint i = 0; i < storage.size(); ++i) {
            storage[i].buffer = get(gl, GL_SHADER_STORAGE_BUFFER_BINDING, i);
            gl.GetInteger64i_v(GL_SHADER_STORAGE_BUFFER_START, i, &storage[i].start);
            gl.GetInteger64i_v(GL_SHADER_STORAGE_BUFFER_SIZE, i, &storage[i].size);
        }
        for (std::size_t t = 0; t < bound.size(); ++t)
            bound[t] = get(gl, buffer_targets[t].binding);
    }
    void restore(const GladGLContext& gl) const {
        for (GLuint i = 0; i < storage.size(); ++i) {
            const auto& [buffer, start, size] = storage[i];
            // A size of 0 means all of the buffer: it was bound without a range.
            size ? gl.BindBufferRange(GL_SHADER_STORAGE_BUFFER, i, buffer, start, size)
                 : gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, i, buffer);
        }
        // After the indexed ones, which move it.
        gl.BindBuffer(GL_SHADER_STORAGE_BUFFER, generic_storage);
        for (std::size_t t = 0; t < bound.size(); ++t)
            gl.BindBuffer(buffer_targets[t].target, bound[t]);
    }
};

struct Pipeline {
    GLint draw_framebuffer, read_framebuffer, renderbuffer, program, vertex_array;

    void save(const GladGLContext& gl) {
        draw_framebuffer = get(gl, GL_DRAW_FRAMEBUFFER_BINDING);
        read_framebuffer = get(gl, GL_READ_FRAMEBUFFER_BINDING);
        renderbuffer = get(gl, GL_RENDERBUFFER_BINDING);
        program = get(gl, GL_CURRENT_PROGRAM);
        vertex_array = get(gl, GL_VERTEX_ARRAY_BINDING);
    }
    void restore(const GladGLContext& gl) const {
        gl.BindFramebuffer(GL_DRAW_FRAMEBUFFER, draw_framebuffer);
        gl.BindFramebuffer(GL_READ_FRAMEBUFFER, read_framebuffer);
        gl.BindRenderbuffer(GL_RENDERBUFFER, renderbuffer);
        gl.UseProgram(program);
        gl.BindVertexArray(vertex_array);
    }
};

constexpr std::array pixel_store = {
    GL_PACK_ALIGNMENT,   GL_PACK_ROW_LENGTH,    GL_PACK_IMAGE_HEIGHT,   GL_PACK_SKIP_PIXELS,
    GL_PACK_SKIP_ROWS,   GL_PACK_SKIP_IMAGES,   GL_PACK_SWAP_BYTES,     GL_PACK_LSB_FIRST,
    GL_UNPACK_ALIGNMENT, GL_UNPACK_ROW_LENGTH,  GL_UNPACK_IMAGE_HEIGHT, GL_UNPACK_SKIP_PIXELS,
    GL_UNPACK_SKIP_ROWS, GL_UNPACK_SKIP_IMAGES, GL_UNPACK_SWAP_BYTES,   GL_UNPACK_LSB_FIRST};

struct PixelStore {
    std::array<GLint, pixel_store.size()> values;

    void save(const GladGLContext& gl) {
        for (std::size_t i = 0; i < values.size(); ++i) values[i] = get(gl, pixel_store[i]);
    }
    void restore(const GladGLContext& gl) const {
        for (std::size_t i = 0; i < values.size(); ++i) gl.PixelStorei(pixel_store[i], values[i]);
    }
};

}  // namespace

struct StateGuard::Saved {
    std::tuple<Switches, Fragments, Rasterization, TextureUnits, Images, Buffers, Pipeline,
               PixelStore>
        parts;

    void save(const GladGLContext& gl) {
        std::apply([&](auto&... part) { (part.save(gl), ...); }, parts);
    }
    void restore(const GladGLContext& gl) const {
        std::apply([&](const auto&... part) { (part.restore(gl), ...); }, parts);
    }
};

void set_default_state(const GladGLContext& gl) {
    for (const GLenum capability : switches) gl.Disable(capability);
    gl.Enable(GL_MULTISAMPLE);
    gl.Disable(GL_BLEND);
    gl.Disable(GL_SCISSOR_TEST);
    gl.BlendFunc(GL_ONE, GL_ZERO);
    gl.BlendEquation(GL_FUNC_ADD);
    gl.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    gl.DepthMask(GL_TRUE);
    gl.DepthFunc(GL_LESS);
    gl.DepthRangef(0.f, 1.f);
    gl.PolygonOffset(0.f, 0.f);
    gl.PolygonMode(GL_FRONT_AND_BACK, GL_FILL);
    gl.FrontFace(GL_CCW);
    gl.CullFace(GL_BACK);
    gl.ClipControl(GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
    gl.ProvokingVertex(GL_LAST_VERTEX_CONVENTION);
    gl.LineWidth(1.f);
    gl.PointSize(1.f);
    gl.UseProgram(0);
    gl.BindVertexArray(0);
    gl.BindSamplers(0, at_most(gl, GL_MAX_COMBINED_TEXTURE_IMAGE_UNITS, texture_units), nullptr);
    for (const Target& target : buffer_targets) gl.BindBuffer(target.target, 0);
    for (const GLenum name : pixel_store) {
        const bool alignment = name == GL_PACK_ALIGNMENT || name == GL_UNPACK_ALIGNMENT;
        gl.PixelStorei(name, alignment ? 1 : 0);
    }
}

StateGuard::StateGuard(const GladGLContext& gl) : gl_{gl}, saved_{std::make_unique<Saved>()} {
    saved_->save(gl);
    set_default_state(gl);
}

StateGuard::~StateGuard() {
    saved_->restore(gl_);
}

}  // namespace opacity::gl
