// Triangles through a face: cut where they are not before it, and even in space, not in the
// picture.
#include <algorithm>

#include "map/surface.hpp"
#include "map/triangle_fragments.hpp"

namespace opacity {
namespace {

struct Vertex {
    float3 q{};  // light coordinates
    float forward = 0.f;
    float opacity = 0.f;
    float2 uv{};
};

Vertex mixed(const Vertex& a, const Vertex& b, float place) {
    Vertex result;
    for (std::size_t i = 0; i < 3; ++i) result.q[i] = a.q[i] + place * (b.q[i] - a.q[i]);
    result.forward = a.forward + place * (b.forward - a.forward);
    result.opacity = a.opacity + place * (b.opacity - a.opacity);
    for (std::size_t i = 0; i < 2; ++i) result.uv[i] = a.uv[i] + place * (b.uv[i] - a.uv[i]);
    return result;
}

// What of the triangle is before the face: a polygon of up to four corners (Sutherland and Hodgman
// 1974).
std::vector<Vertex> before_face(const std::array<Vertex, 3>& triangle) {
    std::vector<Vertex> polygon;
    for (std::size_t i = 0; i < 3; ++i) {
        const Vertex &a = triangle[i], &b = triangle[(i + 1) % 3];
        const bool a_is_before = a.forward >= least_forward,
                   b_is_before = b.forward >= least_forward;
        if (a_is_before) polygon.push_back(a);
        if (a_is_before != b_is_before)
            polygon.push_back(mixed(a, b, (least_forward - a.forward) / (b.forward - a.forward)));
    }
    return polygon;
}

class FaceTriangle {
   public:
    FaceTriangle(const std::array<Vertex, 3>& vertices, const MapFace& face,
                 const LightSpace& space)
        : vertices_{vertices}, face_{face}, space_{space} {
        for (std::size_t i = 0; i < 3; ++i) {
            const float3 place = face.place(vertices[i].q);
            places_[i] = {place[0], place[1], place[2], 0.f};
        }
    }
    const std::array<float4, 3>& places() const { return places_; }

    FaceTexel at(const TriangleTexel& t) const {
        const Vertex here = vertex({t.weights[0], t.weights[1], t.weights[2]});
        FaceTexel texel{t.x, t.y, face_.depth(here.q), margin(here), here.opacity, here.uv, {}, {}};
        const Vertex right = beside(t, 1.f, 0.f), below = beside(t, 0.f, 1.f);
        for (std::size_t i = 0; i < 2; ++i) {
            texel.along_x[i] = right.uv[i] - here.uv[i];
            texel.along_y[i] = below.uv[i] - here.uv[i];
        }
        return texel;
    }

   private:
    // By the weights of its picture's corners.
    Vertex vertex(const float3& weights) const {
        float3 even;
        for (std::size_t i = 0; i < 3; ++i) even[i] = weights[i] / vertices_[i].forward;
        const float sum = even[0] + even[1] + even[2];
        for (float& part : even) part /= sum;
        Vertex result;
        result.opacity = between_corners(even.data(), vertices_[0].opacity, vertices_[1].opacity,
                                         vertices_[2].opacity);
        for (std::size_t i = 0; i < 3; ++i) {
            const float part = even[i];
            result.q = plus(result.q, scaled(vertices_[i].q, part));
            result.forward += part * vertices_[i].forward;
            for (std::size_t k = 0; k < 2; ++k) result.uv[k] += part * vertices_[i].uv[k];
        }
        return result;
    }
    Vertex beside(const TriangleTexel& t, float dx, float dy) const {
        const auto& p = places_;
        const float area =
            (p[1][0] - p[0][0]) * (p[2][1] - p[0][1]) - (p[1][1] - p[0][1]) * (p[2][0] - p[0][0]);
        float3 weights;
        for (std::size_t i = 0; i < 3; ++i) {
            const float4 &a = p[(i + 1) % 3], &b = p[(i + 2) % 3];
            weights[i] = t.weights[i] + ((b[0] - a[0]) * dy - (b[1] - a[1]) * dx) / area;
        }
        return vertex(weights);
    }
    float margin(const Vertex& here) const {
        const float3 a = minus(vertices_[1].q, vertices_[0].q);
        const float3 b = minus(vertices_[2].q, vertices_[0].q);
        const float largest = largest_surface_margin(face_.texels_per_unit(face_.seen(here.q)[2]),
                                                     space_.depth_range);
        return surface_margin(
            surface_slope(face_.place_change(here.q, scaled(a, 1.f / std::max(length(a), 1e-30f))),
                          face_.place_change(here.q, scaled(b, 1.f / std::max(length(b), 1e-30f)))),
            largest);
    }

    std::array<Vertex, 3> vertices_;
    const MapFace& face_;
    const LightSpace& space_;
    std::array<float4, 3> places_{};
};

}  // namespace

void face_triangle_texels(const LightCaster& caster, const std::uint32_t* corners,
                          const LightSpace& space, const MapFace& face, Rows rows,
                          const std::function<void(const FaceTexel&)>& texel) {
    std::array<Vertex, 3> triangle;
    for (std::size_t i = 0; i < 3; ++i) {
        const float4& p = caster.points[corners[i]];
        triangle[i].q = {p[0], p[1], p[2]};
        triangle[i].forward = face.seen(triangle[i].q)[2];
        triangle[i].opacity = caster.opacity_at(corners[i]);
        if (!caster.uvs.empty()) triangle[i].uv = caster.uvs[corners[i]];
    }
    const std::vector<Vertex> polygon = before_face(triangle);
    for (std::size_t i = 2; i < polygon.size(); ++i) {
        const FaceTriangle part{{polygon[0], polygon[i - 1], polygon[i]}, face, space};
        triangle_texels(part.places(), space, rows,
                        [&](const TriangleTexel& t) { texel(part.at(t)); });
    }
}

}  // namespace opacity
