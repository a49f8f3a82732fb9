// The strands of generated scenes, point by point.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <utility>
#include <vector>

#include "opacity/scene/strands.hpp"

namespace opacity::demo {

class StrandArrays {
   public:
    // `segments` in strands of so many each, of which the last is cut where the number is reached.
    StrandArrays(std::size_t segments, std::size_t segments_each)
        : left_{segments}, each_{segments_each} {
        const std::size_t points = segments + (segments + segments_each - 1) / segments_each;
        xyz_.reserve(3 * points);
        width_.reserve(points);
        color_.reserve(points);
    }

    bool full() const { return left_ == 0; }
    // One strand: at(i) gives its point i, from 0 at the root to `segments_each` at the tip.
    struct Point {
        glm::dvec3 position;
        double width;
        glm::dvec3 color;
    };
    template <class At>
    void add(const At& at) {
        const std::size_t segments = left_ < each_ ? left_ : each_;
        for (std::size_t i = 0; i <= segments; ++i) {
            const Point point = at(i);
            const glm::dvec3 &p = point.position, &c = point.color;
            xyz_.insert(xyz_.end(), {float(p.x), float(p.y), float(p.z)});
            color_.push_back({float(c.x), float(c.y), float(c.z)});
            width_.push_back(float(point.width));
        }
        offsets_.push_back(std::int64_t(width_.size()));
        left_ -= segments;
    }

    std::shared_ptr<Strands> strands(float opacity) && {
        return std::make_shared<Strands>(Positions{std::move(xyz_)}, std::move(offsets_),
                                         std::move(width_), std::vector{opacity},
                                         std::move(color_));
    }

   private:
    std::size_t left_, each_;
    std::vector<float> xyz_, width_;
    std::vector<float3> color_;
    std::vector<std::int64_t> offsets_{0};
};

}  // namespace opacity::demo
