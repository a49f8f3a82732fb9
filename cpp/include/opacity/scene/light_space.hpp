// Light space: where a point lies in a light's map. x and y in texels, z the linear distance from
// the light as a fraction of the casters' range. lib/light.glsl says the same.
//
// World points first become light coordinates. Of a directional light these are the place in the
// map already. A positional light sees them through faces, each a perspective of its own: one where
// its casters fit one, six around it where they do not, as many for each point of an area. All
// faces lie side by side in one map, row by row. So do the splits of a directional light: windows
// of its map that are finer, for parts of the camera's view.
#pragma once

#include <array>
#include <vector>

#include "opacity/core/math.hpp"

namespace opacity {

// In light coordinates, whose unit is the depth range: r = axes q + offset, z forward; the place is
// focal_px r.xy / r.z + middle_px, and the depth |r| - |offset| + depth_of_origin, which keeps its
// digits however far the light is from the casters.
struct LightFace {
    std::array<double, 9> axes{1, 0, 0, 0, 1, 0, 0, 0, 1};  // rows: right, down, forward
    double3 offset{};
    double focal_px = 1.0;
    std::array<double, 2> middle_px{};
    double depth_of_origin = 0.0;
    bool operator==(const LightFace&) const = default;

    double3 seen(const double3& q) const;
    double3 turned_back(const double3& r) const;  // axes transposed
};

// Nothing nearer than this before a face, in depth ranges, is seen by it.
inline constexpr float least_forward = 1e-4f;

// Light coordinates of a directional light to one of its splits: x and y in texels, z as it is.
struct LightSplit {
    double scale = 1.0;
    std::array<double, 2> offset_px{};
    bool operator==(const LightSplit&) const = default;

    double3 place(const double3& q) const {
        return {scale * q[0] + offset_px[0], scale * q[1] + offset_px[1], q[2]};
    }
};

struct LightSpace {
    double4x4 from_world = identity;  // to light coordinates
    int map_size_px = 1;              // along each side of a face, or split
    double depth_range = 1.0;         // world units from depth 0 to depth 1
    // 1 / the side of a texel of the whole map in world units; of a positional light, at one depth
    // range before it.
    double texels_per_unit = 1.0;
    double least_bias = 0.0;       // world units
    std::vector<LightFace> faces;  // none: directional
    int faces_an_eye = 1;          // or 6: forward is +z, -z, +x, -x, +y, -y
    // Of a directional light: the whole map, then what is finer, first that nearest to the camera.
    // A place is looked up in the first of these that holds it, else in the whole map. None: the
    // whole map alone.
    std::vector<LightSplit> splits = {};
    // The part of the strands that its map holds, each as many times as wide:
    // scene/strand_ranks.hpp.
    double strand_detail = 1.0;
    bool operator==(const LightSpace&) const = default;

    bool is_parallel() const { return faces.empty(); }
    bool is_one_map() const { return faces.empty() && splits.empty(); }
    // Maps side by side: faces, or splits.
    int face_count() const {
        return is_one_map() ? 1 : int(is_parallel() ? splits.size() : faces.size());
    }
    int eye_count() const { return face_count() / faces_an_eye; }
    // Faces side by side, as square as they come.
    int columns() const;
    int width_px() const { return columns() * map_size_px; }
    int height_px() const { return (face_count() + columns() - 1) / columns() * map_size_px; }
    // The first texel of a face.
    std::array<int, 2> corner_px(int face) const {
        return {face % columns() * map_size_px, face / columns() * map_size_px};
    }
};

// From light coordinates.
double4x4 world_from(const LightSpace& space);

}  // namespace opacity
