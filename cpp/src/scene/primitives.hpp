// The primitives of a shape by number: segments, triangles or particles, and the points of each.
#pragma once

#include <cstddef>
#include <cstdint>

#include "opacity/scene/shape.hpp"

namespace opacity {

// Valid while the shape lives and keeps its connectivity. A volume is none of these, and has no
// primitives.
class Primitives {
   public:
    explicit Primitives(const Shape& shape);

    std::size_t count() const { return count_; }
    // Of one primitive: 2, 3 or 1 points.
    std::size_t corners() const { return corners_; }
    std::uint32_t point(std::size_t primitive, std::size_t corner) const {
        if (!indices_) return std::uint32_t(primitive);
        return corners_ == 3 ? indices_[3 * primitive + corner]
                             : indices_[primitive] + std::uint32_t(corner);
    }
    // Of an index buffer: triangles by their corners, all else two triangles a quadrilateral.
    std::size_t indices_each() const { return corners_ == 3 ? 3 : 6; }

   private:
    const std::uint32_t* indices_ = nullptr;  // corners of triangles, first points of segments
    std::size_t corners_ = 1, count_ = 0;
};

}  // namespace opacity
