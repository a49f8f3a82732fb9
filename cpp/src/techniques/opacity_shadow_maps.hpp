// Opacity shadow maps (Kim and Neumann, "Opacity Shadow Maps", Eurographics Workshop on Rendering
// 2001).
//
// Idea: slices across the light, the same for all texels; each holds the optical depth in front of
// it. A look-up interpolates between the two slices around a receiver. Slices are even, dense where
// casters are (1D BSP), or dense near the light (gamma).
//
// Cost: ceil(N / 32) blended passes into ceil(N / 4) RGBA32F layers, 16 ceil(N / 4) bytes a texel;
// RGBA16F half of it, RGBA8 a quarter. By scatter one pass, whatever N is, and 4 N bytes a texel
// more. Slicing by density, when the casters, their opacity or the
// light changed: 2 more passes and one read-back. Look-up: 4 texels, 2 slices each (4 with cubic
// interpolation), whatever N is. With buffers = "two" the casters are drawn N times, 16 bytes a
// texel are all, and M points are asked once each in their slices: pseudo code, loops 2 to 4. These
// are blended whatever the deposit.
//
// Fails: light that enters a slice fades from its front on, whatever lies there; where surfaces
// slope toward the light each slice shows as a band, and neighbouring texels that begin at
// different depths get different light. It takes hundreds of slices to hide them; deep_opacity_maps
// has none.
//
// Of the paper: points, lines and polygons are particles, strands and meshes, and volumes besides.
// The kernel of 3 x 3 texels is filter = "box" with filter_radius = 1.5. Shadow samples are what is
// asked about: a shape's vertices, any points, or in a picture what the camera sees, and no more.
// Opaque casters have a depth map of their own. What lies behind all slices is looked up in the
// farthest one. Many volumes apart from each other: with buffers = "two" a caster is drawn for the
// slices that it lies in and the few behind it alone; from then on what is stored of it is loaded.
#pragma once

#include <string_view>

#include "techniques/layered.hpp"

namespace opacity::techniques {

class OpacityShadowMaps : public Layered {
   public:
    OpacityShadowMaps()
        : Layered{"opacity_shadow_maps", 1024, "Slices across the light, the last at the end."} {}

    std::string_view summary() const override {
        return "Opacity layers between slices across the light, the same for all texels.";
    }
    std::string_view paper() const override { return "Kim and Neumann 2001"; }
    LookUp build(FrameGraph& graph, const ShadowInputs& inputs) override;

    Choice slicing{*this,
                   "slicing",
                   {"uniform", "density", "gamma"},
                   "Where the slices lie: evenly; where most light is lost (1D BSP); or near the "
                   "light, at powers gamma of even steps."};
    Param<double> gamma{*this, "gamma", 2.2, {1.0, 8.0}, "Of slicing gamma: 1 is uniform."};
    Choice interpolation{*this,
                         "interpolation",
                         {"linear", "cubic"},
                         "Between slices: a line, or a monotone cubic through four."};
    Choice buffers{*this,
                   "buffers",
                   {"all", "two"},
                   "two: points and vertices are asked slice by slice, with no more maps than the "
                   "slices around them; pictures, and filter_domain density, keep all."};
    AutoParam<double> kappa{*this,
                            "kappa",
                            {0.1, 100.0},
                            "The optical depth of a full channel with accumulator unorm8; auto: 8 "
                            "ln 2, where T is one step of 8 bits."};

   private:
    void add_slices(FrameGraph& graph, const ShadowInputs& inputs, const DepositWay& way,
                    Planes& planes) const;
};

}  // namespace opacity::techniques
