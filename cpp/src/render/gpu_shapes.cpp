#include "render/gpu_shapes.hpp"

#include "opacity/scene/mesh.hpp"
#include "opacity/scene/strands.hpp"

namespace opacity::render {
namespace {

template <class T>
gl::Buffer make_buffer(const std::shared_ptr<gl::Context>& context, const std::vector<T>& content) {
    // OpenGL has no empty buffers: an empty shape still needs something to bind.
    static constexpr float nothing[4] = {};
    if (content.empty()) return gl::Buffer{context, sizeof nothing, nothing};
    return gl::Buffer{context, content.size() * sizeof(T), content.data()};
}

// Runs `make` and keeps its buffer when the part was made from another revision.
template <class Make>
void refresh(GpuPart& part, Revision revision, Make make) {
    if (part.buffer && part.revision == revision) return;
    part.buffer.emplace(make());
    part.revision = revision;
}

// Two triangles a segment, over its four corners (lib/segment.glsl).
std::vector<std::uint32_t> ribbon_triangles(std::size_t segment_count) {
    std::vector<std::uint32_t> indices;
    indices.reserve(6 * segment_count);
    for (std::uint32_t corner = 0; corner < 4 * segment_count; corner += 4)
        indices.insert(indices.end(),
                       {corner, corner + 1, corner + 2, corner, corner + 2, corner + 3});
    return indices;
}

// std430 would pad a vec3 anyway.
std::vector<float> padded(const std::vector<float3>& vectors) {
    std::vector<float> result;
    result.reserve(4 * vectors.size());
    for (const float3& v : vectors) result.insert(result.end(), {v[0], v[1], v[2], 0.f});
    return result;
}

}  // namespace

const GpuShape& GpuShapes::upload(const ShapePtr& shape_ptr) {
    const Shape& shape = *shape_ptr;
    const auto lock = shape.lock();
    GpuShape& gpu = shapes_[&shape];
    // Another shape at the address of one that is gone: no revision of it can match.
    gpu.shape = shape_ptr;
    gpu.transform = shape.transform();
    gpu.width_scale = float(shape.scale());
    gpu.receives = shape.receives();
    gpu.opaque = shape.opaque();
    gpu.deposits = shape.is_caster() && !gpu.opaque;
    gpu.receiver_width = float(shape.strand_width());
    upload_geometry(gpu, shape);
    upload_appearance(gpu, shape);
    return gpu;
}

void GpuShapes::upload_geometry(GpuShape& gpu, const Shape& shape) const {
    const Revision now = shape.revisions().geometry;
    const auto* strands = dynamic_cast<const Strands*>(&shape);
    const auto* mesh = dynamic_cast<const Mesh*>(&shape);
    refresh(gpu.points, now, [&] {
        const Box bounds = shape.points().bounds();
        gpu.origin = bounds.empty() ? double3{} : bounds.center();
        static const std::vector<float> no_width = {0.f};
        return make_buffer(context_, shape.points().relative_to(
                                         gpu.origin, strands ? strands->width() : no_width));
    });
    if (strands)
        refresh(gpu.segments, now, [&] {
            gpu.segment_count = int(strands->segments().size());
            return make_buffer(context_, strands->segments());
        });
    if (mesh)
        refresh(gpu.normals, now, [&] { return make_buffer(context_, padded(mesh->normals())); });
    refresh(gpu.triangles, now, [&] {
        const std::vector<std::uint32_t> indices =
            mesh ? mesh->triangles() : ribbon_triangles(strands->segments().size());
        gpu.index_count = int(indices.size());
        return make_buffer(context_, indices);
    });
}

void GpuShapes::upload_appearance(GpuShape& gpu, const Shape& shape) const {
    refresh(gpu.opacity, shape.revisions().opacity, [&] {
        gpu.opacity_stride = shape.opacity().size() > 1 ? 1 : 0;
        return make_buffer(context_, shape.opacity());
    });
    refresh(gpu.color, shape.revisions().color, [&] {
        gpu.color_stride = shape.color().size() > 1 ? 1 : 0;
        std::vector<float> flat;
        for (const float3& c : shape.color()) flat.insert(flat.end(), c.begin(), c.end());
        return make_buffer(context_, flat);
    });
}

void GpuShapes::collect() {
    std::erase_if(shapes_, [](const auto& entry) { return entry.second.shape.expired(); });
}

}  // namespace opacity::render
