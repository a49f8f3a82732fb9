// Copies of casters as the light sees them: points in light space, float32 as the GPU has them,
// made again only when the shape or the light has moved.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <vector>

#include "map/alpha.hpp"
#include "map/caster_bands.hpp"
#include "map/volume_slabs.hpp"
#include "opacity/scene/light_space.hpp"
#include "opacity/scene/particles.hpp"
#include "opacity/scene/shape.hpp"

namespace opacity {

enum class CasterKind { strands, mesh, particles, volume };

struct LightCaster {
    CasterKind kind = CasterKind::mesh;
    // Light coordinates; w: a strand's width or a particle's radius, in texels or, where the light
    // has faces, in depth ranges.
    std::vector<float4> points;
    std::vector<std::uint32_t> indices;  // first points of segments; or corners of triangles
    std::vector<float> opacity;          // one for all, or one a point
    DensityProfile profile = DensityProfile::sphere;  // of particles
    // Of a mesh with an alpha map, else none.
    std::vector<float2> uvs;
    std::vector<TextureMap> coverage;
    // Of a volume.
    std::shared_ptr<const Volume> volume;  // what it shares with the shape
    std::vector<Slab> slabs;
    std::array<float4, 4> light_from_voxels{}, voxels_from_light{};  // columns
    CasterBands bands;

    float opacity_at(std::size_t i) const { return opacity[opacity.size() > 1 ? i : 0]; }
};

class LightCasters {
   public:
    // As the shape is now; stays until the next call for it.
    const LightCaster& caster(const ShapePtr& shape, const LightSpace& space);
    // Forgets shapes that are gone.
    void collect();

    // Whether to leave out the chunks of a shape that the map cannot hold anything of.
    void set_culling(bool on) { culls_ = on; }

   private:
    struct Cached {
        std::weak_ptr<const Shape> shape;
        Revision geometry = 0, transform = 0, opacity = 0;
        LightSpace space;
        bool culled = false;
        LightCaster caster;
    };
    bool culls_ = true;
    std::map<const Shape*, Cached> cache_;
};

}  // namespace opacity
