#include "io/spacing.hpp"

#include <algorithm>
#include <cmath>

namespace opacity {

// Each against all others: the time is the number of points, whatever their arrangement.
float half_mean_spacing(const Positions& points) {
    constexpr std::size_t samples = 256;
    const std::size_t count = std::min(points.size(), samples);
    double sum = 0.0;
    std::size_t places = 0;
    for (std::size_t k = 0; k < count; ++k) {
        const double3 a = points[k * points.size() / count];
        double nearest = Box::infinity;
        for (std::size_t i = 0; i < points.size(); ++i) {
            const double3 b = points[i];
            const double x = a[0] - b[0], y = a[1] - b[1], z = a[2] - b[2];
            const double squared = x * x + y * y + z * z;
            if (squared > 0.0) nearest = std::min(nearest, squared);
        }
        if (nearest == Box::infinity) continue;
        sum += std::sqrt(nearest);
        ++places;
    }
    return places > 0 ? float(0.5 * sum / double(places)) : 0.5f;
}

}  // namespace opacity
