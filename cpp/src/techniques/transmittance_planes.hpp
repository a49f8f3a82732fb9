// Layer planes for each tile of texels at equal steps of transmittance, by layers that are drawn.
#pragma once

#include "opacity/technique.hpp"
#include "techniques/drawn_layers.hpp"

namespace opacity::techniques {

// How many layers the planes are for: a value, or a parameter, that shaders know as u_layers.
struct LayerCount {
    const Source& source;
    int count;
};

struct WantedPlanes {
    TilePlanes planes;
    LayerCount layers;
    float even_part;
};

// So many planes are spread over depth, not over what the light loses: receivers are also where
// that is little, and what is told of the casters is coarse.
float even_part_for(const DrawList& casters);
// Of planes that are laid by each other frame after frame: with less they gather about casters.
constexpr float steady_even_part = 0.6f;

// The pass of this name, of the technique of this shader, which lays planes by the layers told.
void add_transmittance_planes(FrameGraph& graph, const ShadowInputs& inputs,
                              const std::string& shader, const std::string& name,
                              const DrawnLayers& told, const WantedPlanes& wanted);

// A texture for so many layers' planes.
TextureDesc tile_planes_desc(const ShadowInputs& inputs, int layers, int tile_px);

}  // namespace opacity::techniques
