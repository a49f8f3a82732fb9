// Triangles: opaque (opacity 1), or translucent with one opacity for all or one a vertex.
#pragma once

#include <cstdint>
#include <vector>

#include "opacity/scene/shape.hpp"

namespace opacity {

class Mesh : public Shape {
   public:
    // Three indices a triangle. Without normals, area-weighted vertex normals are made, and made
    // again whenever the points move. Given normals are brought to length 1; one of length 0 is
    // made as well.
    Mesh(Positions positions, std::vector<std::uint32_t> triangles,
         std::vector<float3> normals = {}, std::vector<float> opacity = {1.f},
         std::vector<float3> color = {{0.7f, 0.7f, 0.7f}});

    const char* kind() const override { return "mesh"; }
    bool opaque() const override;

    const std::vector<std::uint32_t>& triangles() const { return triangles_; }
    const std::vector<float3>& normals() const { return normals_; }
    void set_normals(std::vector<float3> normals);  // none: made from the points again
    bool own_normals() const { return own_normals_; }

   private:
    void points_changed() override;
    std::vector<float3> made_normals() const;
    std::vector<float3> completed(std::vector<float3> normals) const;

    std::vector<std::uint32_t> triangles_;
    std::vector<float3> normals_;
    bool own_normals_ = false;
};

}  // namespace opacity
