// Size and look of a renderer's pictures, and of the lights' maps.
#pragma once

#include "opacity/core/param.hpp"

namespace opacity {

struct RenderSettings : ParamOwner {
    RenderSettings() : ParamOwner{"renderer", "pyopacity render --help"} {}
    Param<int> width{*this, "width", 1024, {1, 16384}, "Pixels of the picture, across."};
    Param<int> height{*this, "height", 768, {1, 16384}, "Pixels of the picture, down."};
    AutoParam<int> map_size{*this,
                            "map_size",
                            512,
                            {1, 16384},
                            "Texels along each side of the light's maps; auto: from the width and "
                            "spacing of the strands, or from filter_width."};
    AutoParam<double> map_detail{
        *this,
        "map_detail",
        1.0,
        {1e-3, 1.0},
        "Part of the strands that the lights' maps hold, each as many times as wide; auto: as few "
        "as add a root mean square error of .02 at most to T."};
    Param<bool> steady{
        *this, "steady", true,
        "A light holds on to its map while what casts lies within, so that shadows do "
        "not swim; off: each frame fits anew, whatever was before."};
    Param<bool> culling{*this, "culling", true,
                        "Parts of shapes that a camera or a light cannot see are not drawn; off: "
                        "all of each shape that is in view, for the same result."};
    Param<int> antialiasing{*this, "antialiasing", 2, {1, 8}, "n x n samples a pixel, averaged."};
    Choice compositing{
        *this,
        "compositing",
        {"auto", "opaque", "subsets", "sorted", "exact", "maps"},
        "How what is translucent covers what lies behind it: opaque, as in the "
        "papers; subsets: the mean of three, each of a third of the strands; sorted "
        "by shape and primitive; exact: sorted lists; maps: without an order, by "
        "maps of the camera's own; auto: sorted where strands, particles or a volume "
        "alone are translucent, else maps."};
    Choice strand_look_up{
        *this,
        "strand_look_up",
        {"auto", "per_sample", "along_strands"},
        "Where T of strands is looked up: at each sample of the picture; or along "
        "the strands, every third texel of the light's map, and again only when "
        "light or casters move; auto: along them where that is not much more."};
    Param<double> ambient{*this,
                          "ambient",
                          0.12,
                          {0.0, 100.0},
                          "Light from everywhere, unshadowed, as a factor of colour."};
    Param<double> specular{*this, "specular", 0.25, {0.0, 100.0}, "Strength of the highlight."};
    Param<double> shininess{*this, "shininess", 40.0, {1.0, 10000.0}, "Exponent of the highlight."};
    Param<double> wrap{*this,
                       "wrap",
                       0.0,
                       {0.0, 1.0},
                       "How far light reaches around the edge of a surface's lit side."};
    AutoParam<double> backlight{*this,
                                "backlight",
                                {0.0, 1.0},
                                "Part of the light on a translucent surface that comes out on its "
                                "other side; auto: it has no sides, only the maps darken it."};
    Param<double> phase{*this,
                        "phase",
                        0.0,
                        {-0.99, 0.99},
                        "Mean cosine of scattering in particles and volumes; 0: to all sides, "
                        "above: onward."};
    Param<double> shadow_intensity{
        *this, "shadow_intensity", 1.0, {0.0, 1.0}, "Part of the shadow that the picture shows."};
};

}  // namespace opacity
