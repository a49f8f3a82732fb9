#include "render/gpu_shapes.hpp"

#include <algorithm>
#include <span>

#include "map/alpha.hpp"
#include "map/volume_slabs.hpp"
#include "opacity/scene/particles.hpp"
#include "opacity/scene/strands.hpp"
#include "render/primitive_indices.hpp"
#include "scene/primitive_chunks.hpp"

namespace opacity::render {
namespace {

template <class T>
gl::Buffer make_buffer(const std::shared_ptr<gl::Context>& context, const std::vector<T>& content) {
    // OpenGL has no empty buffers: an empty shape still needs something to bind.
    static constexpr float nothing[4] = {};
    if (content.empty()) return gl::Buffer{context, sizeof nothing, nothing};
    return gl::Buffer{context, content.size() * sizeof(T), content.data()};
}

gl::Texture make_texture(const std::shared_ptr<gl::Context>& context, GLenum format,
                         const std::vector<TextureMap>& levels) {
    gl::Texture texture{context, GL_TEXTURE_2D,     format, levels[0].width, levels[0].height,
                        1,       int(levels.size())};
    for (std::size_t level = 0; level < levels.size(); ++level)
        texture.write(std::as_bytes(std::span{levels[level].values}), int(level));
    texture.set_filter(GL_LINEAR);
    texture.set_wrap(GL_REPEAT);
    return texture;
}

// std430 would pad a vec3 anyway.
std::vector<float> padded(const std::vector<float3>& vectors) {
    std::vector<float> result;
    result.reserve(4 * vectors.size());
    for (const float3& v : vectors) result.insert(result.end(), {v[0], v[1], v[2], 0.f});
    return result;
}

// OpenGL has textures of 1, 2 and 4 channels.
TextureMap with_fourth_channel(const TextureMap& rgb) {
    TextureMap rgba{rgb.width, rgb.height, 4, {}};
    rgba.values.reserve(rgb.values.size() / 3 * 4);
    for (std::size_t i = 0; i < rgb.values.size(); i += 3)
        rgba.values.insert(rgba.values.end(),
                           {rgb.values[i], rgb.values[i + 1], rgb.values[i + 2], 1.f});
    return rgba;
}

// Two vectors a slab (casters/volume.vert.glsl): its first corner and axis, its last corner.
std::vector<float> slab_corners(const std::vector<Slab>& slabs) {
    std::vector<float> result;
    for (const Slab& slab : slabs) {
        const auto& [begin, end] = std::pair{slab.begin, slab.end};
        for (const int i : begin) result.push_back(float(i));
        result.push_back(float(slab.axis));
        for (const int i : end) result.push_back(float(i));
        result.push_back(0.f);
    }
    return result;
}

const char* define_of(const Shape& shape) {
    if (dynamic_cast<const Strands*>(&shape)) return "STRANDS";
    if (dynamic_cast<const Particles*>(&shape)) return "PARTICLES";
    return dynamic_cast<const Volume*>(&shape) ? "VOLUME" : "MESH";
}

// Whether the opacity maps hold what own_correction takes out.
bool deposits(const Shape& shape) {
    const auto* mesh = dynamic_cast<const Mesh*>(&shape);
    return shape.is_caster() && !shape.opaque() && !(mesh && mesh->has_alpha());
}

Defines defines_of(const Shape& shape) {
    const bool is_body = dynamic_cast<const Mesh*>(&shape) && shape.opaque();
    Defines defines{{define_of(shape), "1"}};
    if (is_body) defines.emplace_back("OPAQUE", "1");
    if (shape.receives()) defines.emplace_back("RECEIVES", "1");
    if (deposits(shape)) defines.emplace_back("DEPOSITS", "1");
    return defines;
}

// What lies beside the points in a buffer of four floats each.
const std::vector<float>& widths_of(const Shape& shape) {
    static const std::vector<float> none{0.f};
    if (const auto* strands = dynamic_cast<const Strands*>(&shape)) return strands->width();
    if (const auto* particles = dynamic_cast<const Particles*>(&shape)) return particles->radius();
    return none;
}

}  // namespace

template <class Object, class Make>
void GpuShapes::refresh(GpuPart<Object>& part, Part kind, Revision revision, Make make) {
    if (part.object && part.revision == revision) return;
    std::weak_ptr<Object>& shared = held(part)[{kind, revision}];
    part.object = shared.lock();
    if (!part.object) part.object = std::make_shared<Object>(make());
    shared = part.object;
    part.revision = revision;
}

const GpuShape& GpuShapes::upload(const ShapePtr& shape_ptr, bool with_ranks) {
    const Shape& shape = *shape_ptr;
    const auto lock = shape.lock();
    GpuShape& gpu = shapes_[&shape];
    // Another shape at the address of one that is gone: no revision of it can match.
    if (gpu.shape.lock() != shape_ptr) gpu = {};
    gpu.shape = shape_ptr;
    gpu.transform = shape.transform();
    gpu.width_scale = float(shape.scale());
    gpu.receiver_width = float(shape.strand_width());
    gpu.defines = defines_of(shape);
    upload_geometry(gpu, shape);
    upload_appearance(gpu, shape);
    if (with_ranks) upload_ranks(gpu, shape);
    return gpu;
}

void GpuShapes::upload_geometry(GpuShape& gpu, const Shape& shape) {
    const Revision now = shape.revisions().geometry;
    if (gpu.points.revision != now) {
        const Box bounds = shape.points().bounds();
        gpu.origin = bounds.empty() ? double3{} : bounds.center();
    }
    refresh(gpu.points, Part::points, now, [&] {
        return make_buffer(context_, shape.points().relative_to(gpu.origin, widths_of(shape)));
    });
    if (const auto* mesh = dynamic_cast<const Mesh*>(&shape)) return upload_mesh(gpu, *mesh);
    if (const auto* volume = dynamic_cast<const Volume*>(&shape))
        return upload_volume(gpu, *volume);
    if (const auto* strands = dynamic_cast<const Strands*>(&shape)) {
        gpu.segment_count = int(strands->segments().size());
        refresh(gpu.segments, Part::segments, now,
                [&] { return make_buffer(context_, strands->segments()); });
    }
    if (const auto* particles = dynamic_cast<const Particles*>(&shape))
        gpu.profile = int(particles->profile());
    gpu.quad_count = int(Primitives{shape}.count());
    upload_indices(gpu, shape);
}

void GpuShapes::upload_indices(GpuShape& gpu, const Shape& shape) {
    const auto chunks = shape.chunks();
    gpu.index_count = int(chunks->order->size() * Primitives{shape}.indices_each());
    refresh(gpu.indices, Part::indices, chunks->order_revision,
            [&] { return make_buffer(context_, indices_of(Primitives{shape}, *chunks->order)); });
    refresh(gpu.order, Part::order, chunks->order_revision,
            [&] { return make_buffer(context_, *chunks->order); });
}

// A shape keeps its strands, and they their ranks.
void GpuShapes::upload_ranks(GpuShape& gpu, const Shape& shape) {
    const auto* strands = dynamic_cast<const Strands*>(&shape);
    if (!strands || gpu.ranks) return;
    gpu.ranks = strands->ranks();
    std::vector<float> of_segments;
    for (const std::size_t strand : strand_numbers(*strands))
        of_segments.push_back(float(gpu.ranks->of_strands[strand]));
    refresh(gpu.strand_ranks, Part::strand_ranks, strands->chunks()->order_revision,
            [&] { return make_buffer(context_, of_segments); });
}

void GpuShapes::upload_mesh(GpuShape& gpu, const Mesh& mesh) {
    const Revision now = mesh.revisions().geometry;
    refresh(gpu.normals, Part::normals, now,
            [&] { return make_buffer(context_, padded(mesh.normals())); });
    upload_indices(gpu, mesh);
    if (!mesh.uvs().empty())
        refresh(gpu.uvs, Part::uvs, now, [&] { return make_buffer(context_, mesh.uvs()); });
    if (!mesh.has_alpha()) return;
    gpu.defines.emplace_back("ALPHA_MAP", "1");
    refresh(gpu.alpha, Part::alpha, now,
            [&] { return make_texture(context_, GL_R32F, coverage_levels(mesh)); });
}

void GpuShapes::upload_volume(GpuShape& gpu, const Volume& volume) {
    const Revision now = volume.revisions().geometry;
    gpu.local_from_voxels = local_from_voxels(volume);
    gpu.spacing = volume.spacing();
    refresh(gpu.extinction, Part::extinction, now, [&] {
        const auto& [nz, ny, nx] = volume.size_zyx();
        gl::Texture texture{context_, GL_TEXTURE_3D, GL_R32F, nx, ny, nz};
        texture.write(std::as_bytes(std::span{volume.extinction()}));
        return texture;
    });
    const auto faces = [](const std::vector<Slab>& slabs) { return 6 * slabs.size(); };
    if (gpu.slabs.revision == now) return;
    const std::vector<Slab> slabs = slabs_of(volume);
    gpu.index_count = int(6 * faces(slabs));
    refresh(gpu.slabs, Part::slabs, now,
            [&] { return make_buffer(context_, slab_corners(slabs)); });
    refresh(gpu.indices, Part::indices, now,
            [&] { return make_buffer(context_, quad_triangles(faces(slabs))); });
}

void GpuShapes::upload_appearance(GpuShape& gpu, const Shape& shape) {
    refresh(gpu.opacity, Part::opacity, shape.revisions().opacity,
            [&] { return make_buffer(context_, shape.opacity()); });
    gpu.opacity_stride = shape.opacity().size() > 1 ? 1 : 0;
    gpu.color_stride = shape.color().size() > 1 ? 1 : 0;
    refresh(gpu.color, Part::color, shape.revisions().color, [&] {
        std::vector<float> flat;
        for (const float3& c : shape.color()) flat.insert(flat.end(), c.begin(), c.end());
        return make_buffer(context_, flat);
    });
    const auto* mesh = dynamic_cast<const Mesh*>(&shape);
    if (!mesh || !mesh->color_map() || mesh->uvs().empty()) {
        gpu.color_map = {};
        return;
    }
    gpu.defines.emplace_back("COLOR_MAP", "1");
    refresh(gpu.color_map, Part::color_map, shape.revisions().color, [&] {
        return make_texture(context_, GL_RGBA32F,
                            texture_levels(with_fourth_channel(*mesh->color_map())));
    });
}

void GpuShapes::collect() {
    std::erase_if(shapes_, [](const auto& entry) { return entry.second.shape.expired(); });
    const auto is_gone = [](const auto& entry) { return entry.second.expired(); };
    std::erase_if(buffers_, is_gone);
    std::erase_if(textures_, is_gone);
}

}  // namespace opacity::render
