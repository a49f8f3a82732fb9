#include "render/gl_device.hpp"

#include <algorithm>

#include "gl/check.hpp"
#include "gl/glsl_namespace.hpp"
#include "opacity/core/error.hpp"
#include "render/drawing_order.hpp"
#include "render/feed_shape.hpp"
#include "render/program_feeder.hpp"
#include "techniques/registry.hpp"

namespace opacity::render {

namespace {

constexpr GLenum face_clip_distances = 5;  // casters.vert.glsl
constexpr std::size_t indices_a_quad = 6;
constexpr const char* camera_space = "camera";  // Shader::camera_technique

// As OpenGL takes it: bytes from the start of the buffer.
const void* index_offset(std::size_t first) {
    return reinterpret_cast<const void*>(first * sizeof(std::uint32_t));
}

// Whether any view of the pass does.
bool sees_fewer_strands(const Pass& pass) {
    const Reads reads = all_reads(pass);
    return std::ranges::any_of(reads, [](const Source* read) {
        const auto* view = dynamic_cast<const View*>(read);
        return view && view->strand_detail() < 1.0;
    });
}

// Of 8 bits a channel, as floats of [0, 1].
void read_bytes(const gl::Texture& texture, std::span<std::byte> floats) {
    std::vector<std::byte> bytes(texture.size_bytes());
    texture.read(bytes);
    auto* to = reinterpret_cast<float*>(floats.data());
    for (const std::byte value : bytes) *to++ = float(value) / 255.f;
}

}  // namespace

unsigned internal_format(Format format) {
    switch (format) {
        case Format::depth32f:
            return GL_DEPTH_COMPONENT32F;
        case Format::r32f:
            return GL_R32F;
        case Format::rgba16f:
            return GL_RGBA16F;
        case Format::rgba8:
            return GL_RGBA8;
        case Format::r32ui:
            return GL_R32UI;
        case Format::rgba32ui:
            return GL_RGBA32UI;
        default:
            return GL_RGBA32F;
    }
}

GlDevice::GlDevice(std::shared_ptr<gl::Context> context)
    : context_{std::move(context)},
      shapes_{context_},
      orders_{context_},
      framebuffer_{context_},
      vertex_array_{context_} {}

Revision GlDevice::shader_revision() {
    if (registered_revision_ != registered_revision()) {
        registered_revision_ = registered_revision();
        for (const RegisteredTechnique& technique : registered_techniques())
            library_.add(technique.shader_path(), technique.shader);
    }
    return library_.revision();
}

void GlDevice::allocate(const Resource& resource) {
    release(resource);
    if (const auto* texture = dynamic_cast<const Texture*>(&resource)) {
        const TextureDesc& desc = texture->desc();
        const GLenum target = desc.layers > 0 ? GL_TEXTURE_2D_ARRAY : GL_TEXTURE_2D;
        const auto make = [&](int factor) {
            return gl::Texture{context_,
                               target,
                               internal_format(desc.format),
                               desc.width * factor,
                               desc.height * factor,
                               std::max(desc.layers, 1)};
        };
        Image image{make(content_scale(desc)), nullptr};
        if (desc.oversampling > content_scale(desc))
            image.samples = std::make_unique<gl::Texture>(make(desc.oversampling));
        images_.emplace(resource.name(), std::move(image));
    } else {
        const auto& buffer = dynamic_cast<const Buffer&>(resource);
        buffers_.emplace(resource.name(),
                         gl::Buffer{context_, std::max<std::size_t>(buffer.size_bytes(), 16)});
    }
}

void GlDevice::release(const Resource& resource) noexcept {
    images_.erase(resource.name());
    buffers_.erase(resource.name());
}

unsigned GlDevice::drawn_texture(const Texture& texture) const {
    const Image& image = images_.at(texture.name());
    return (image.samples ? *image.samples : image.texture).name();
}

void GlDevice::bind_targets(const Pass& pass) {
    // A framebuffer anew for each pass: attachments of the last one must not linger.
    framebuffer_ = gl::Framebuffer{context_};
    const GLuint fbo = framebuffer_.name();
    std::vector<GLenum> draw_buffers;
    int width = 1, height = 1;
    const auto note_size = [&](const TextureDesc& desc) {
        width = desc.width * desc.oversampling;
        height = desc.height * desc.oversampling;
    };
    for (const Target& target : pass.writes) {
        const TextureDesc& desc = target.texture->desc();
        const bool depth = desc.format == Format::depth32f;
        const GLenum attachment =
            depth ? GL_DEPTH_ATTACHMENT : GL_COLOR_ATTACHMENT0 + GLenum(draw_buffers.size());
        if (!depth) draw_buffers.push_back(attachment);
        if (desc.layers > 0)
            gl().NamedFramebufferTextureLayer(fbo, attachment, drawn_texture(*target.texture), 0,
                                              target.layer);
        else
            gl().NamedFramebufferTexture(fbo, attachment, drawn_texture(*target.texture), 0);
        note_size(desc);
    }
    if (pass.tests) {
        gl().NamedFramebufferTexture(fbo, GL_DEPTH_ATTACHMENT, drawn_texture(*pass.tests), 0);
        note_size(pass.tests->desc());
    } else if (pass.writes
                   .empty()) {  // the shader stores into images: the first one gives the size
        for (const Resource* store : pass.stores)
            if (const auto* texture = dynamic_cast<const Texture*>(store)) {
                note_size(texture->desc());
                break;
            }
        gl().NamedFramebufferParameteri(fbo, GL_FRAMEBUFFER_DEFAULT_WIDTH, width);
        gl().NamedFramebufferParameteri(fbo, GL_FRAMEBUFFER_DEFAULT_HEIGHT, height);
    }
    gl().NamedFramebufferDrawBuffers(fbo, GLsizei(draw_buffers.size()), draw_buffers.data());
    if (gl().CheckNamedFramebufferStatus(fbo, GL_DRAW_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
        throw Error("the driver cannot draw into the targets of pass \"" + pass.name + "\"",
                    "lower map_size, size or antialiasing; pyopacity doctor shows the driver");
    gl().BindFramebuffer(GL_DRAW_FRAMEBUFFER, fbo);
    gl().Viewport(0, 0, width, height);
}

void GlDevice::set_state(const Pass& pass) const {
    const State& state = pass.state;
    const auto toggle = [&](GLenum capability, bool on) {
        on ? gl().Enable(capability) : gl().Disable(capability);
    };
    toggle(GL_DEPTH_TEST, state.depth != Depth::off);
    gl().DepthFunc(state.depth == Depth::greater ? GL_GREATER : GL_LESS);
    gl().DepthMask(pass.tests ? GL_FALSE : GL_TRUE);
    toggle(GL_BLEND, state.blend != Blend::off);
    gl().BlendEquation(GL_FUNC_ADD);
    if (state.blend == Blend::bounds) {
        gl().BlendEquation(GL_MAX);
        gl().BlendEquationi(0, GL_MIN);
    }
    if (state.largest_alpha) gl().BlendEquationSeparatei(0, GL_FUNC_ADD, GL_MAX);
    gl().BlendFunc(GL_ONE, state.blend == Blend::over ? GL_ONE_MINUS_SRC_ALPHA : GL_ONE);
    gl().DepthRangef(state.swaps_depth_range ? 1.f : 0.f, state.swaps_depth_range ? 0.f : 1.f);
    const bool through_faces = pass.view && pass.view->faces() > 0;
    for (GLenum plane = GL_CLIP_DISTANCE0; plane < GL_CLIP_DISTANCE0 + face_clip_distances; ++plane)
        toggle(plane, through_faces);
    gl().Disable(GL_CULL_FACE);
    gl().Disable(GL_SCISSOR_TEST);
    gl().ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    // Depth as it comes out of the projection, without the half of its precision that -1 .. 1
    // loses.
    gl().ClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
}

void GlDevice::clear(const Pass& pass) {
    bind_targets(pass);
    set_state(pass);
    GLint color = 0;
    for (const Target& target : pass.writes) {
        if (target.texture->desc().format == Format::depth32f)
            gl().ClearNamedFramebufferfv(framebuffer_.name(), GL_DEPTH, 0, &pass.state.clear_depth);
        else
            gl().ClearNamedFramebufferfv(
                framebuffer_.name(), GL_COLOR, color++,
                target.clear_color.value_or(pass.state.clear_color).data());
    }
    if (pass.draws && pass.draws->shapes().empty()) resolve(pass);
    gl::check_errors(*context_, "clearing the targets of pass " + pass.name);
}

gl::Program& GlDevice::program(const Shader& shader, const Defines& shape_defines) {
    if (programs_revision_ != library_.revision()) programs_.clear();
    programs_revision_ = library_.revision();
    std::unique_ptr<gl::Program>& program = programs_[{shader, shape_defines}];
    if (program) return *program;
    std::vector<gl::Stage> stages;
    if (!shader.vertex.empty()) stages.push_back({GL_VERTEX_SHADER, shader.vertex});
    if (!shader.fragment.empty()) stages.push_back({GL_FRAGMENT_SHADER, shader.fragment});
    if (!shader.compute.empty()) stages.push_back({GL_COMPUTE_SHADER, shader.compute});
    Defines defines = shader.defines;
    defines.insert(defines.end(), shape_defines.begin(), shape_defines.end());
    if (context_->is_software()) defines.emplace_back("SOFTWARE", "1");
    gl::Aliases aliases;
    if (!shader.technique.empty()) aliases["technique.glsl"] = shader.technique;
    const bool has_camera = !shader.camera_technique.empty();
    const gl::Namespaces spaces{
        {"camera/technique.glsl",
         {camera_space, has_camera ? shader.camera_technique : "techniques/unshadowed.glsl"}}};
    for (const auto& [name, value] : shader.camera_defines)
        defines.emplace_back(gl::in_namespace(name, camera_space), value);
    program = std::make_unique<gl::Program>(context_, library_, stages, defines, aliases, spaces);
    return *program;
}

void GlDevice::draw(const Pass& pass, const Uniforms& extra, const ShapeFilter& wanted) {
    bind_targets(pass);
    set_state(pass);
    gl().BindVertexArray(vertex_array_.name());
    const std::vector<ShapePtr>& shapes = pass.draws->shapes();
    for (const std::size_t index : drawing_order(pass))
        if (!wanted || wanted(*shapes[index])) draw_shape(pass, shapes[index], int(index), extra);
    gl().MemoryBarrier(GL_ALL_BARRIER_BITS);
    resolve(pass);
    gl::check_errors(*context_, "drawing pass " + pass.name);
}

void GlDevice::feed(gl::Program& shader, const Pass& pass, const GpuShape& gpu, int index,
                    const Indices& indices, const Uniforms& extra) {
    ProgramFeeder feeder{*this, shader};
    feed_shape(feeder, pass, gpu);
    feeder.buffer("casters", indices.primitives);
    feeder.uniform("u_shape_index", index);
    for (const Source* read : pass.reads) read->feed(feeder);
    if (pass.view) pass.view->feed(feeder);
    feeder.set_space(camera_space);
    for (const Source* read : pass.camera_reads) read->feed(feeder);
    feeder.set_space("");
    for (const Resource* store : pass.stores) feeder.store(*store);
    for (const auto& [name, value] : extra) feeder.uniform(name, value);
    feeder.require_complete(pass);
}

void GlDevice::draw_shape(const Pass& pass, const ShapePtr& shape, int index,
                          const Uniforms& extra) {
    const GpuShape& gpu = shapes_.upload(shape, sees_fewer_strands(pass));
    if (gpu.index_count == 0) return;
    Shader drawing = pass.shader;
    drawing.compute.clear();
    gl::Program& shader = program(drawing, gpu.defines);
    const Indices indices = orders_.indices(pass, shape, gpu);
    feed(shader, pass, gpu, index, indices, extra);
    gl().UseProgram(shader.name());
    gl().VertexArrayElementBuffer(vertex_array_.name(), indices.buffer);
    draw_ranges(indices.ranges, pass.view->faces());
}

// All of them in one call, unless each is drawn once for every face.
void GlDevice::draw_ranges(const std::vector<IndexRange>& ranges, int faces) {
    if (ranges.empty()) return;
    if (faces > 1) {
        for (const IndexRange& range : ranges)
            gl().DrawElementsInstanced(GL_TRIANGLES, GLsizei(range.count), GL_UNSIGNED_INT,
                                       index_offset(range.first), faces);
        calls_ += ranges.size();
        return;
    }
    std::vector<GLsizei> counts;
    std::vector<const void*> firsts;
    for (const IndexRange& range : ranges) {
        counts.push_back(GLsizei(range.count));
        firsts.push_back(index_offset(range.first));
    }
    gl().MultiDrawElements(GL_TRIANGLES, counts.data(), GL_UNSIGNED_INT, firsts.data(),
                           GLsizei(ranges.size()));
    ++calls_;
}

void GlDevice::dispatch(const Pass& pass, std::array<int, 3> groups, const Uniforms& extra) {
    Shader computing = pass.shader;
    computing.vertex.clear(), computing.fragment.clear();
    gl::Program& shader = program(computing, {});
    ProgramFeeder feeder{*this, shader};
    for (const Source* read : pass.reads) read->feed(feeder);
    for (const Resource* store : pass.stores) feeder.store(*store);
    for (const auto& [name, value] : extra) feeder.uniform(name, value);
    feeder.require_complete(pass);
    gl().UseProgram(shader.name());
    gl().DispatchCompute(GLuint(groups[0]), GLuint(groups[1]), GLuint(groups[2]));
    ++calls_;
    gl().MemoryBarrier(GL_ALL_BARRIER_BITS);
    gl::check_errors(*context_, "computing pass " + pass.name);
}

void GlDevice::dispatch_shapes(const Pass& pass, const ShapeFilter& wanted) {
    Shader computing = pass.shader;
    computing.vertex.clear(), computing.fragment.clear();
    int index = 0;
    for (const ShapePtr& shape : pass.draws->shapes()) {
        const int here = index++;
        if (!wanted || wanted(*shape)) dispatch_shape(pass, computing, shape, here);
    }
    gl().MemoryBarrier(GL_ALL_BARRIER_BITS);
    gl::check_errors(*context_, "computing the shapes of pass " + pass.name);
}

void GlDevice::dispatch_shape(const Pass& pass, const Shader& computing, const ShapePtr& shape,
                              int index) {
    const GpuShape& gpu = shapes_.upload(shape, sees_fewer_strands(pass));
    if (gpu.quad_count == 0) return;
    gl::Program& shader = program(computing, gpu.defines);
    const Indices indices = orders_.indices(pass, shape, gpu);
    feed(shader, pass, gpu, index, indices, {{"u_quad_first", 0}, {"u_quad_count", 0}});
    gl().UseProgram(shader.name());
    for (const IndexRange& range : indices.ranges) {
        const int count = int(range.count / indices_a_quad);
        shader.set("u_quad_first", int(range.first / indices_a_quad));
        shader.set("u_quad_count", count);
        const auto [columns, rows, one] = work_groups(count);
        gl().DispatchCompute(GLuint(columns), GLuint(rows),
                             GLuint(std::max(1, pass.view->faces())));
        ++calls_;
    }
}

void GlDevice::resolve(const Pass& pass) {
    for (const Target& target : pass.writes) {
        const TextureDesc& desc = target.texture->desc();
        if (desc.oversampling == 1 || desc.format == Format::depth32f) continue;
        const Image& image = images_.at(target.texture->name());
        gl::Program& shader = program({.compute = "resolve.comp.glsl"}, {});
        shader.set("u_oversampling", desc.oversampling);
        gl().BindTextureUnit(GLuint(*shader.sampler("t_samples")), image.samples->name());
        gl().BindImageTexture(GLuint(*shader.image("i_average")), image.texture.name(), 0, GL_FALSE,
                              0, GL_WRITE_ONLY, image.texture.internal_format());
        gl().UseProgram(shader.name());
        gl().DispatchCompute(GLuint(desc.width + 7) / 8, GLuint(desc.height + 7) / 8, 1);
        ++calls_;
        gl().MemoryBarrier(GL_ALL_BARRIER_BITS);
    }
}

void GlDevice::zero(const Resource& resource) {
    const auto image = images_.find(resource.name());
    image != images_.end() ? image->second.texture.clear() : buffers_.at(resource.name()).clear();
}

void GlDevice::fill(const Texture& texture, float value) {
    images_.at(texture.name()).texture.fill(value);
}

void GlDevice::write(const Resource& resource, std::span<const std::byte> content) {
    if (content.empty()) return;
    const auto image = images_.find(resource.name());
    image != images_.end() ? image->second.texture.write(content)
                           : buffers_.at(resource.name()).write(content);
}

void GlDevice::read(const Resource& resource, std::span<std::byte> content) {
    if (content.empty()) return;
    const auto image = images_.find(resource.name());
    if (image == images_.end())
        buffers_.at(resource.name()).read(content);
    else if (image->second.texture.internal_format() == GL_RGBA8)
        read_bytes(image->second.texture, content);
    else
        image->second.texture.read(content);
}

void GlDevice::finish() {
    gl().Finish();
}

}  // namespace opacity::render
