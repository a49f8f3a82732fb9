// Executes passes with OpenGL: owns the storage of resources, the programs, and the buffers of
// shapes.
#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <utility>

#include "gl/buffer.hpp"
#include "gl/program.hpp"
#include "gl/shader_library.hpp"
#include "gl/texture.hpp"
#include "opacity/gl/context.hpp"
#include "opacity/graph/device.hpp"
#include "render/gpu_shapes.hpp"
#include "render/primitive_orders.hpp"

namespace opacity::render {

unsigned internal_format(Format format);

class GlDevice : public Device {
   public:
    explicit GlDevice(std::shared_ptr<gl::Context> context);

    Revision shader_revision() override;
    void allocate(const Resource& resource) override;
    void release(const Resource& resource) noexcept override;
    void clear(const Pass& pass) override;
    void draw(const Pass& pass, const Uniforms& extra, const ShapeFilter& wanted) override;
    void dispatch(const Pass& pass, std::array<int, 3> groups, const Uniforms& extra) override;
    void dispatch_shapes(const Pass& pass, const ShapeFilter& wanted) override;
    void zero(const Resource& resource) override;
    void fill(const Texture& texture, float value) override;
    void write(const Resource& resource, std::span<const std::byte> content) override;
    void read(const Resource& resource, std::span<std::byte> content) override;
    void finish() override;
    std::size_t calls() const override { return calls_; }

    void collect() override {
        shapes_.collect();
        orders_.collect();
    }

   private:
    // The texture, and where it is oversampled the larger one that is drawn into.
    struct Image {
        gl::Texture texture;
        std::unique_ptr<gl::Texture> samples;
    };
    friend class ProgramFeeder;

    // Of a pass that draws and dispatches each has a program of its own.
    gl::Program& program(const Shader& shader, const Defines& shape_defines);
    // Makes the pass's targets current: without any, a framebuffer of the size of what it stores
    // into.
    void bind_targets(const Pass& pass);
    void set_state(const Pass& pass) const;
    // What a pass's program takes, for one of its shapes.
    void feed(gl::Program& shader, const Pass& pass, const GpuShape& gpu, int index,
              const Indices& indices, const Uniforms& extra);
    // `index` in the pass's list.
    void draw_shape(const Pass& pass, const ShapePtr& shape, int index, const Uniforms& extra);
    void draw_ranges(const std::vector<IndexRange>& ranges, int faces);
    void dispatch_shape(const Pass& pass, const Shader& computing, const ShapePtr& shape,
                        int index);
    void resolve(const Pass& pass);
    unsigned drawn_texture(const Texture& texture) const;
    const GladGLContext& gl() const { return context_->gl(); }

    std::shared_ptr<gl::Context> context_;
    gl::ShaderLibrary library_;
    Revision registered_revision_ = 0;  // of the techniques whose shaders it knows
    GpuShapes shapes_;
    PrimitiveOrders orders_;
    std::map<std::string, Image> images_;  // by the resource's name
    std::map<std::string, gl::Buffer> buffers_;
    // By shader and kind of shape; those of an older revision of the shaders are gone.
    std::map<std::pair<Shader, Defines>, std::unique_ptr<gl::Program>> programs_;
    Revision programs_revision_ = 0;
    std::size_t calls_ = 0;
    gl::Framebuffer framebuffer_;
    gl::VertexArray vertex_array_;  // empty: shapes are pulled from storage buffers
};

}  // namespace opacity::render
