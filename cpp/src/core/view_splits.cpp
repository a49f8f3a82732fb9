#include "opacity/core/view_splits.hpp"

#include <cmath>

namespace opacity {

std::vector<double> view_cuts(double near, double far, const ViewSplits& splits) {
    std::vector<double> cuts{near};
    for (int i = 1; i < splits.count; ++i) {
        const double part = double(i) / splits.count;
        const double logarithmic = near * std::pow(far / near, part);
        const double uniform = near + part * (far - near);
        cuts.push_back(splits.mix * logarithmic + (1.0 - splits.mix) * uniform);
    }
    cuts.push_back(far);
    return cuts;
}

}  // namespace opacity
