#include "opacity/scene/light_space.hpp"

namespace opacity {

double3 LightFace::seen(const double3& q) const {
    double3 r = offset;
    for (std::size_t row = 0; row < 3; ++row)
        for (std::size_t i = 0; i < 3; ++i) r[row] += axes[3 * row + i] * q[i];
    return r;
}

double3 LightFace::turned_back(const double3& r) const {
    double3 q{};
    for (std::size_t row = 0; row < 3; ++row)
        for (std::size_t i = 0; i < 3; ++i) q[i] += axes[3 * row + i] * r[row];
    return q;
}

int LightSpace::columns() const {
    int columns = 1;
    while (columns * columns < face_count()) ++columns;
    return columns;
}

// It turns, moves and scales along its own axes: the rows of such a matrix are orthogonal.
double4x4 world_from(const LightSpace& space) {
    const double4x4& m = space.from_world;
    double4x4 result{};
    for (int row = 0; row < 3; ++row) {
        double squared = 0.0;
        for (int i = 0; i < 3; ++i) squared += m[4 * row + i] * m[4 * row + i];
        for (int i = 0; i < 3; ++i) {
            result[4 * i + row] = m[4 * row + i] / squared;
            result[4 * i + 3] -= m[4 * row + 3] * m[4 * row + i] / squared;
        }
    }
    result[15] = 1.0;
    return result;
}

}  // namespace opacity
