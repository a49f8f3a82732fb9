// One face of a positional light's map in float32, as lib/light.glsl has it, in the same order of
// operations.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/vector.hpp"
#include "opacity/scene/light_space.hpp"

namespace opacity {

// At depth z it is at origin + z direction, in light coordinates.
struct LightRay {
    float3 origin, direction;
    float begin;  // nothing in front of this depth is met by it
};

class MapFace {
   public:
    MapFace(const LightSpace& space, int face)
        : corner_px{space.corner_px(face)}, depth_range_{float(space.depth_range)} {
        const LightFace& f = space.faces[std::size_t(face)];
        std::copy(f.axes.begin(), f.axes.end(), axes_.begin());
        std::copy(f.offset.begin(), f.offset.end(), offset_.begin());
        focal_px_ = float(f.focal_px);
        middle_px_ = {float(f.middle_px[0]), float(f.middle_px[1])};
        depth_of_origin_ = float(f.depth_of_origin);
    }

    // Light coordinates to the face's axes: right, down, forward.
    float3 seen(const float3& q) const { return plus(turned(q), offset_); }
    float depth(const float3& q) const {
        const float3 s = turned(q);
        const float lengths = std::max(length(plus(s, offset_)) + length(offset_), 1e-30f);
        return dot(s, plus(s, scaled(offset_, 2.f))) / lengths + depth_of_origin_;
    }
    // Only where seen(q)[2] > 0.
    float3 place(const float3& q) const {
        const float3 r = seen(q);
        return {focal_px_ * r[0] / r[2] + middle_px_[0], focal_px_ * r[1] / r[2] + middle_px_[1],
                depth(q)};
    }
    // The derivative of place along dq.
    float3 place_change(const float3& q, const float3& dq) const {
        const float3 r = seen(q), dr = turned(dq);
        const float forward = dr[2] / r[2];
        return {focal_px_ * (dr[0] - r[0] * forward) / r[2],
                focal_px_ * (dr[1] - r[1] * forward) / r[2],
                dot(r, dr) / std::max(length(r), 1e-30f)};
    }
    float texels_per_unit(float forward) const { return focal_px_ / (forward * depth_range_); }
    // The width in texels, across its own direction, of a ribbon that faces the light.
    float ribbon_width(const float3& q, const float3& along, float width) const {
        const float3 side = cross(turned(along), seen(q));
        const float scale = width / std::sqrt(std::max(dot(side, side), 1e-30f));
        const float3 across = place_change(q, turned_back(scaled(side, scale)));
        const float3 d = place_change(q, along);
        const float squared = std::max(d[0] * d[0] + d[1] * d[1], 1e-30f);
        return std::abs(d[0] * across[1] - d[1] * across[0]) / std::sqrt(squared);
    }

    float focal_px() const { return focal_px_; }
    // The light through a place on the face.
    LightRay ray(const float2& texel) const {
        const float x = (texel[0] - middle_px_[0]) / focal_px_;
        const float y = (texel[1] - middle_px_[1]) / focal_px_;
        const float3 way = scaled(float3{x, y, 1.f}, 1.f / std::sqrt(x * x + y * y + 1.f));
        const float begin = depth_of_origin_ - length(offset_);
        return {turned_back(minus(scaled(way, -begin), offset_)), turned_back(way), begin};
    }
    // Where light comes from, in light coordinates.
    float3 source() const { return scaled(turned_back(offset_), -1.f); }

    std::array<int, 2> corner_px;

   private:
    float3 turned(const float3& q) const {
        return {axes_[0] * q[0] + axes_[1] * q[1] + axes_[2] * q[2],
                axes_[3] * q[0] + axes_[4] * q[1] + axes_[5] * q[2],
                axes_[6] * q[0] + axes_[7] * q[1] + axes_[8] * q[2]};
    }
    float3 turned_back(const float3& r) const {
        return {axes_[0] * r[0] + axes_[3] * r[1] + axes_[6] * r[2],
                axes_[1] * r[0] + axes_[4] * r[1] + axes_[7] * r[2],
                axes_[2] * r[0] + axes_[5] * r[1] + axes_[8] * r[2]};
    }
    std::array<float, 9> axes_{};
    float3 offset_{};
    float focal_px_ = 1.f, depth_of_origin_ = 0.f, depth_range_ = 1.f;
    std::array<float, 2> middle_px_{};
};

// All faces of a light, and the choice between those of one of its points.
class MapFaces {
   public:
    explicit MapFaces(const LightSpace& space) : faces_an_eye_{space.faces_an_eye} {
        for (int face = 0; face < int(space.faces.size()); ++face) faces_.emplace_back(space, face);
    }
    int eye_count() const { return int(faces_.size()) / faces_an_eye_; }
    const MapFace& operator[](int face) const { return faces_[std::size_t(face)]; }
    // The face through which a point of the light sees q.
    int face_of(int eye, const float3& q) const {
        const int first = eye * faces_an_eye_;
        if (faces_an_eye_ == 1) return first;
        const float3 r = faces_[std::size_t(first)].seen(q);  // whose axes are the world's
        const float ax = std::abs(r[0]), ay = std::abs(r[1]), az = std::abs(r[2]);
        if (az >= ax && az >= ay) return first + (r[2] > 0.f ? 0 : 1);
        return ax >= ay ? first + (r[0] > 0.f ? 2 : 3) : first + (r[1] > 0.f ? 4 : 5);
    }

   private:
    int faces_an_eye_;
    std::vector<MapFace> faces_;
};

}  // namespace opacity
