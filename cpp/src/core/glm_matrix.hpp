// Transforms by rows, as they are kept, and by columns, as GLM computes with them.
#pragma once

#include <glm/glm.hpp>

#include "opacity/core/math.hpp"

namespace opacity {

inline glm::dmat4 to_glm(const double4x4& m) {
    glm::dmat4 result;
    for (int row = 0; row < 4; ++row)
        for (int column = 0; column < 4; ++column) result[column][row] = m[4 * row + column];
    return result;
}

inline double4x4 from_glm(const glm::dmat4& m) {
    double4x4 result;
    for (int row = 0; row < 4; ++row)
        for (int column = 0; column < 4; ++column) result[4 * row + column] = m[column][row];
    return result;
}

}  // namespace opacity
