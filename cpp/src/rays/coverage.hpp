// How much of a surface is there, where its alpha map decides that.
#pragma once

#include <array>

#include "opacity/scene/mesh.hpp"

namespace opacity::rays {

class Coverage {
   public:
    // Of a mesh that has alpha.
    explicit Coverage(const Mesh& mesh)
        : map_{mesh.alpha_map()}, mode_{mesh.alpha_mode()}, cutoff_{mesh.alpha_cutoff()} {}

    // In 0 .. 1, linear between the middles of texels, each of which covers or not in a mask.
    double at(const std::array<double, 2>& uv) const;

   private:
    double texel(int x, int y) const;

    TextureMapPtr map_;
    AlphaMode mode_;
    float cutoff_;
};

}  // namespace opacity::rays
