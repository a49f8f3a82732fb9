// Triangles: opaque (opacity 1), or translucent with one opacity for all or one a vertex; with a
// texture of alpha they are leaves that light passes beside.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "opacity/scene/shape.hpp"
#include "opacity/scene/texture_map.hpp"

namespace opacity {

// What an alpha map means: nothing; a texel covers, or does not, by a cutoff; or it covers in part.
enum class AlphaMode { opaque, mask, blend };

const char* to_string(AlphaMode mode);
AlphaMode alpha_mode(std::string_view name);  // ParameterError for a name that is none

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

    const std::vector<std::uint32_t>& triangles() const { return *triangles_; }
    const std::vector<float3>& normals() const { return *normals_; }
    void set_normals(std::vector<float3> normals);  // none: made from the points again
    bool own_normals() const { return own_normals_; }

    // Where each point lies on the maps: (0, 0) is their top left corner. One a point, or none.
    const std::vector<float2>& uvs() const { return *uvs_; }
    void set_uvs(std::vector<float2> uvs);

    // One channel in 0 .. 1 that opacity is multiplied with; of a mask, texels count as 1 from the
    // cutoff in 0 .. 1 on, else as 0. Null: none.
    void set_alpha(TextureMapPtr map, AlphaMode mode, float cutoff = 0.5f);
    const TextureMapPtr& alpha_map() const { return alpha_map_; }
    AlphaMode alpha_mode() const { return alpha_mode_; }
    float alpha_cutoff() const { return alpha_cutoff_; }
    // Whether alpha decides where the surface is; then light may pass it, and it is not opaque.
    bool has_alpha() const;

    // Linear RGB that the colour is multiplied with; null: none.
    void set_color_map(TextureMapPtr map);
    const TextureMapPtr& color_map() const { return color_map_; }

   private:
    Mesh(const Mesh&) = default;
    ShapePtr clone() const override { return ShapePtr{new Mesh{*this}}; }
    void points_changed() override;
    std::vector<float3> made_normals() const;
    std::vector<float3> completed(std::vector<float3> normals) const;

    Shared<std::vector<std::uint32_t>> triangles_;
    Shared<std::vector<float3>> normals_;
    Shared<std::vector<float2>> uvs_;
    bool own_normals_ = false;
    TextureMapPtr alpha_map_, color_map_;
    AlphaMode alpha_mode_ = AlphaMode::opaque;
    float alpha_cutoff_ = 0.5f;
};

}  // namespace opacity
