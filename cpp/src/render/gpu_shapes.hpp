// The buffers and textures of each shape, uploaded again only when the part that they hold has
// changed; shapes whose revisions are equal share them.
#pragma once

#include <map>
#include <memory>
#include <utility>

#include "gl/buffer.hpp"
#include "gl/texture.hpp"
#include "opacity/graph/pass.hpp"
#include "opacity/scene/mesh.hpp"
#include "opacity/scene/volume.hpp"
#include "scene/strand_ranks.hpp"

namespace opacity::render {

// One part of a shape in the device's memory, and the revision that it was made from.
template <class Object>
struct GpuPart {
    Revision revision = 0;
    std::shared_ptr<Object> object;
};
using GpuBuffer = GpuPart<gl::Buffer>;
using GpuTexture = GpuPart<gl::Texture>;

struct GpuShape {
    std::weak_ptr<const Shape> shape;
    double3 origin{};  // what was subtracted from the points, in float64
    // Points: xyz and a strand's width or a particle's radius.
    GpuBuffer points, segments, indices, normals, uvs, opacity, color;
    GpuBuffer order;              // PrimitiveChunks::order
    GpuBuffer strand_ranks;       // of each segment, where a map holds fewer strands
    GpuBuffer slabs;              // of a volume: map/volume_slabs.hpp
    GpuTexture alpha, color_map;  // of a mesh, with levels; coverage in place of alpha
    GpuTexture extinction;        // of a volume, x first
    // STRANDS, MESH, PARTICLES or VOLUME; of a mesh OPAQUE, ALPHA_MAP, COLOR_MAP; RECEIVES;
    // DEPOSITS where the opacity maps hold what own_correction takes out. Told as defines, so that
    // what a shape does not need is not in its programs.
    Defines defines;
    int segment_count = 0, index_count = 0;  // indices in the order of the shape's chunks
    int quad_count = 0;                      // of strands and particles: one a caster
    int opacity_stride = 0, color_stride = 0;
    // Copied while the shape is locked, so that another thread may move it meanwhile.
    double4x4 transform = identity;
    double4x4 local_from_voxels = identity;  // of a volume: its coordinates from those of voxels
    double3 spacing{1, 1, 1};
    float width_scale = 1.f;
    int profile = 0;                           // of particles: DensityProfile
    float receiver_width = 0.f;                // world units; 0 for a surface
    std::shared_ptr<const StrandRanks> ranks;  // of strands that some map holds fewer of
};

class GpuShapes {
   public:
    explicit GpuShapes(std::shared_ptr<gl::Context> context) : context_{std::move(context)} {}
    // The shape's buffers, brought up to date; with the ranks of its strands if these are wanted.
    const GpuShape& upload(const ShapePtr& shape, bool with_ranks);
    // Frees the buffers of shapes that are gone.
    void collect();

   private:
    enum class Part {
        points,
        segments,
        indices,
        order,
        normals,
        uvs,
        opacity,
        color,
        strand_ranks,
        slabs,
        alpha,
        color_map,
        extinction
    };
    template <class Object>
    using Held = std::map<std::pair<Part, Revision>, std::weak_ptr<Object>>;

    void upload_geometry(GpuShape& gpu, const Shape& shape);
    void upload_indices(GpuShape& gpu, const Shape& shape);
    void upload_ranks(GpuShape& gpu, const Shape& shape);
    void upload_mesh(GpuShape& gpu, const Mesh& mesh);
    void upload_volume(GpuShape& gpu, const Volume& volume);
    void upload_appearance(GpuShape& gpu, const Shape& shape);
    // Runs `make` and keeps its object when the part was made from another revision, unless
    // another shape has the same.
    template <class Object, class Make>
    void refresh(GpuPart<Object>& part, Part kind, Revision revision, Make make);
    Held<gl::Buffer>& held(const GpuBuffer&) { return buffers_; }
    Held<gl::Texture>& held(const GpuTexture&) { return textures_; }

    std::shared_ptr<gl::Context> context_;
    std::map<const Shape*, GpuShape> shapes_;
    Held<gl::Buffer> buffers_;
    Held<gl::Texture> textures_;
};

}  // namespace opacity::render
