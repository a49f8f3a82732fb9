// How a mesh looks: what the materials of every format come down to.
#pragma once

#include "opacity/scene/mesh.hpp"

namespace opacity {

inline constexpr float3 neutral_grey{0.7f, 0.7f, 0.7f};

struct Surface {
    float3 color = neutral_grey;
    float opacity = 1.f;
    TextureMapPtr color_map{}, alpha_map{};
    AlphaMode alpha_mode = AlphaMode::opaque;
    float alpha_cutoff = 0.5f;

    // Colour and opacity are the mesh's from its start: a vertex may have its own.
    void hang_maps_on(Mesh& mesh) const {
        mesh.set_color_map(color_map);
        mesh.set_alpha(alpha_map, alpha_mode, alpha_cutoff);
    }
};

}  // namespace opacity
