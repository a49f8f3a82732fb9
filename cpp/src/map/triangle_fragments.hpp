// The fragments of meshes: the texels whose middle a triangle covers. GLSL: casters/mesh.vert.glsl
// and casters/mesh.frag.glsl.
#pragma once

#include <algorithm>
#include <array>
#include <functional>

#include "core/opacity.hpp"
#include "map/fragment_source.hpp"

namespace opacity {

// A value, not below 0, by its corners'; exactly that of all three where it is one, such as an
// opacity of 1 - 2^-24 or the depth of a surface across the light.
inline float between_corners(const float* weights, float a, float b, float c) {
    return std::max(0.f, a + (weights[1] * (b - a) + weights[2] * (c - a)));
}

// The texels within the rows whose middle one triangle covers, with their weights of its corners;
// and its slope, by which it is moved away from the light.
struct TriangleTexel {
    int x, y;
    float weights[3];
    float margin;
};
void triangle_texels(const std::array<float4, 3>& corners, const LightSpace& space, Rows rows,
                     const std::function<void(const TriangleTexel&)>& texel);

// Those that the triangle may leave fragments in, or more.
Rows triangle_rows(const LightCaster& caster, const std::uint32_t* corners, const MapFace* face,
                   const SplitPlace& split, int map_size_px);

// What one triangle of a mesh with an alpha map covers of a texel.
class TriangleCoverage {
   public:
    // `places`: of its corners in the map.
    TriangleCoverage(const LightCaster& caster, const std::uint32_t* corners,
                     const std::array<float4, 3>& places);
    // Around a place in the map, where the texel's middle is.
    float at(float x, float y) const;

   private:
    const LightCaster& caster_;
    float x_ = 0.f, y_ = 0.f;              // of a corner
    float2 uv_{}, along_x_{}, along_y_{};  // there, and how it changes from texel to texel
    float level_ = 0.f;
};

// A texel that a triangle covers through a face, and the triangle there.
struct FaceTexel {
    int x, y;
    float depth;
    float margin;
    float opacity;
    float2 uv, along_x, along_y;  // how uv changes from texel to texel
};
void face_triangle_texels(const LightCaster& caster, const std::uint32_t* corners,
                          const LightSpace& space, const MapFace& face, Rows rows,
                          const std::function<void(const FaceTexel&)>& texel);

template <class Sink>
void face_triangle_fragments(const LightCaster& caster, const std::uint32_t* corners,
                             const FragmentSource& source, const MapFace& face, Rows rows,
                             Sink&& sink) {
    face_triangle_texels(caster, corners, source.space, face, rows, [&](const FaceTexel& t) {
        float covered = 1.f;
        if (!caster.coverage.empty())
            covered = coverage_at(caster.coverage, t.uv,
                                  coverage_level(caster.coverage, t.along_x, t.along_y));
        if (!(covered > 0.f)) return;
        const float depth = source.moved_back ? t.depth + t.margin : t.depth;
        sink(t.x, t.y, depth, depth, [&] { return optical_depth_of(t.opacity * covered); });
    });
}

template <class Sink>
void triangle_fragments(const LightCaster& caster, std::size_t first, const FragmentSource& source,
                        const MapFace* face, Rows rows, Sink&& sink) {
    const std::uint32_t* corner = &caster.indices[first];
    if (face) {
        face_triangle_fragments(caster, corner, source, *face, rows, sink);
        return;
    }
    std::array<float4, 3> points;
    for (std::size_t i = 0; i < 3; ++i) points[i] = source.split.place(caster.points[corner[i]]);
    const TriangleCoverage coverage{caster, corner, points};
    triangle_texels(points, source.space, rows, [&](const TriangleTexel& t) {
        float depth = between_corners(t.weights, points[0][2], points[1][2], points[2][2]);
        const float opacity =
            between_corners(t.weights, caster.opacity_at(corner[0]), caster.opacity_at(corner[1]),
                            caster.opacity_at(corner[2]));
        const float covered = coverage.at(float(t.x) + 0.5f, float(t.y) + 0.5f);
        if (!(covered > 0.f)) return;
        if (source.moved_back) depth += t.margin;
        sink(t.x, t.y, depth, depth, [&] { return optical_depth_of(opacity * covered); });
    });
}

}  // namespace opacity
