#include "opacity/core/math.hpp"

#include <cmath>

namespace opacity {

double Box::radius() const {
    if (empty()) return 0.0;
    return 0.5 * std::hypot(max[0] - min[0], max[1] - min[1], max[2] - min[2]);
}

Box Box::padded(double margin) const {
    if (empty()) return *this;
    Box result = *this;
    for (int i = 0; i < 3; ++i) {
        result.min[i] -= margin;
        result.max[i] += margin;
    }
    return result;
}

Box Box::transformed(const double4x4& m) const {
    Box result;
    if (empty()) return result;
    for (int corner = 0; corner < 8; ++corner) {
        const double3 p = {corner & 1 ? max[0] : min[0], corner & 2 ? max[1] : min[1],
                           corner & 4 ? max[2] : min[2]};
        result.extend(transform_point(m, p));
    }
    return result;
}

}  // namespace opacity
