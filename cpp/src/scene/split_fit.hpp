// Parallel splits: fits a map of its own to each part of a camera's view, so that what is near the
// camera gets finer shadows (Zhang et al. 2006; thesis, section 2.2). They are windows of the
// directional light's whole map, and reach as deep: casters between the light and a window are kept
// wherever they stand.
#pragma once

#include <vector>

#include "opacity/core/view_splits.hpp"
#include "opacity/scene/light_space.hpp"
#include "opacity/scene/scene.hpp"
#include "scene/view_frustum.hpp"

namespace opacity {

class SplitFit {
   public:
    // The whole map first, then its splits, nearest first; none for fewer than two, for a
    // positional light, and where all of them would not fit one texture, or are tiny. It holds on
    // to a window while that still does, and only then what moves keeps its texels.
    std::vector<LightSplit> fit(const LightSpace& whole, const Scene& scene, const CameraView& view,
                                const ViewSplits& splits);

   private:
    double4x4 whole_{};             // from the world to the whole map that the held ones belong to
    std::vector<LightSplit> held_;  // as fit returned them
};

}  // namespace opacity
