// The picture: what the camera sees of the shapes, lit through the maps of every light, and how the
// translucent ones cover what lies behind them.
#pragma once

#include "render/camera_maps.hpp"
#include "render/fragment_lists.hpp"
#include "render/shading.hpp"

namespace opacity::render {

class Picture {
   public:
    // Declares the passes. With one light and nothing to see through it is a single one; else what
    // each light adds to each kind of shape, sample by sample, and a pass that puts it together.
    const Resource& add(FrameGraph& graph, const PictureInputs& inputs);
    const Shading& shading() const { return shading_; }

   private:
    // What the last pass puts together.
    struct Layers {
        Reads reads;
        Defines defines;
    };
    void add_solids(FrameGraph& graph, const PictureInputs& inputs, std::size_t light,
                    const Target& target) const;
    Texture& add_solid_depth(FrameGraph& graph, const PictureInputs& inputs) const;
    void add_parts(FrameGraph& graph, const PictureInputs& inputs, const Texture& solid_depth,
                   Layers& layers) const;
    void add_blended(FrameGraph& graph, const PictureInputs& inputs, const Texture& solid_depth,
                     Layers& layers);
    void add_sorted(FrameGraph& graph, const PictureInputs& inputs, const Texture& solid_depth,
                    Texture& over) const;
    void add_weighted(FrameGraph& graph, const PictureInputs& inputs, const Texture& solid_depth,
                      Layers& layers);
    static void add_composition(FrameGraph& graph, Layers layers, Texture& image);

    Shading shading_;
    FragmentLists lists_;
    CameraMaps maps_;
};

}  // namespace opacity::render
