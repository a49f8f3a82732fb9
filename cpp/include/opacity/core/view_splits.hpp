// Where a camera's view is cut for parallel splits (Zhang et al. 2006; thesis, section 2.2): near
// the camera a pixel sees less of the world, so the cuts lie denser there.
#pragma once

#include <vector>

namespace opacity {

struct ViewSplits {
    int count = 1;     // 1: the view is not cut
    double mix = 0.5;  // 0: evenly, 1: each split as many times as deep as the one before it
};

// The count + 1 distances from `near` to `far`, both exact: mix times those of a logarithmic split
// plus 1 - mix times those of a uniform one. 0 < near <= far.
std::vector<double> view_cuts(double near, double far, const ViewSplits& splits);

}  // namespace opacity
