// How large a map a scene needs: fine enough for what it holds, and no finer, since a map that sees
// single strands is dearer and, without a wider filter, no better.
#pragma once

#include <string>
#include <vector>

#include "opacity/scene/scene.hpp"

namespace opacity {

struct MapSize {
    int size_px;
    std::string why;
};

class MapSizeRule {
   public:
    // For a map whose casters span `side` world units. A filter of `filter_width` world units is
    // two texels wide; without one (negative), a texel is as wide as the space between neighbouring
    // strands, at least a strand.
    MapSize choose(const Scene& scene, double side, double filter_width);

   private:
    // The mean distance between neighbours, as strands of the scene's length would have it that
    // fill its occupied volume evenly, and the mean width. Found again only when a shape moved.
    struct Spacing {
        double spacing = 0.0, width = 0.0;
    };
    static Spacing measure(const Scene& scene);
    void update(const Scene& scene);
    std::vector<Revision> measured_;
    Spacing spacing_;
};

}  // namespace opacity
