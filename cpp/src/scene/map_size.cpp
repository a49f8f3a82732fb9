#include "scene/map_size.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "core/vector.hpp"
#include "opacity/scene/strands.hpp"
#include "scene/bias.hpp"

namespace opacity {
namespace {

constexpr int smallest_px = 64, largest_px = 4096, step_px = 32;
constexpr int without_strands_px = 512;

// A box in cells, of which segments pass some: so many cells that one within the strands holds a
// dozen segments, and is wider than the space between strands.
class Occupancy {
   public:
    Occupancy(const Box& box, std::size_t segments)
        : box_{box},
          cells_{std::clamp<std::size_t>(std::size_t(std::cbrt(double(segments) / 16.0)), 1, 32)},
          held_(cells_ * cells_ * cells_, false) {}
    // In steps of a cell at most, so that a strand of few segments fills as much as one of many.
    void add(const double3& a, const double3& b) {
        const double3 from = place(a), to = place(b);
        double longest = 1.0;
        for (int axis = 0; axis < 3; ++axis)
            longest = std::max(longest, std::abs(to[axis] - from[axis]));
        const int steps = int(std::ceil(longest));
        for (int step = 0; step <= steps; ++step) mark(from, to, double(step) / steps);
    }
    double volume() const {
        const double cell = (box_.max[0] - box_.min[0]) * (box_.max[1] - box_.min[1]) *
                            (box_.max[2] - box_.min[2]) / double(held_.size());
        return cell * double(std::count(held_.begin(), held_.end(), true));
    }

   private:
    // In cells.
    double3 place(const double3& p) const {
        double3 result{};
        for (int axis = 0; axis < 3; ++axis) {
            const double extent = box_.max[axis] - box_.min[axis];
            if (extent > 0.0) result[axis] = (p[axis] - box_.min[axis]) / extent * double(cells_);
        }
        return result;
    }
    void mark(const double3& from, const double3& to, double along) {
        std::size_t index = 0;
        for (int axis = 0; axis < 3; ++axis) {
            const double cell = from[axis] + along * (to[axis] - from[axis]);
            index = index * cells_ + std::size_t(std::clamp(cell, 0.0, double(cells_ - 1)));
        }
        held_[index] = true;
    }
    Box box_;
    std::size_t cells_;
    std::vector<bool> held_;
};

// Calls visit(a, b) for both ends of every segment that casts, in the world.
template <class Visit>
void for_each_segment(const Scene& scene, Visit visit) {
    for (const ShapePtr& shape : scene.shapes()) {
        const auto* strands = dynamic_cast<const Strands*>(shape.get());
        if (!strands) continue;
        const auto lock = strands->lock();
        if (!strands->is_caster()) continue;
        for (const std::uint32_t first : strands->segments())
            visit(transform_point(strands->transform(), strands->points()[first]),
                  transform_point(strands->transform(), strands->points()[first + 1]));
    }
}

std::string reason(const char* what, double texel) {
    char text[128];
    std::snprintf(text, sizeof text, "%s: a texel of %.3g", what, texel);
    return text;
}

}  // namespace

MapSizeRule::Spacing MapSizeRule::measure(const Scene& scene) {
    Box box;
    double length = 0.0;
    std::size_t segments = 0;
    for_each_segment(scene, [&](const double3& a, const double3& b) {
        box.extend(a);
        box.extend(b);
        length += distance(a, b);
        ++segments;
    });
    if (!(length > 0.0)) return {};
    Occupancy occupancy{box, segments};
    for_each_segment(scene, [&](const double3& a, const double3& b) { occupancy.add(a, b); });
    return {std::sqrt(occupancy.volume() / length), mean_strand_width(scene.shapes())};
}

MapSize MapSizeRule::choose(const Scene& scene, double side, double filter_width) {
    double texel = 0.5 * filter_width;
    const char* what = "half of filter_width";
    if (!(filter_width > 0.0)) {
        update(scene);
        const bool apart = spacing_.spacing > spacing_.width;
        texel = apart ? spacing_.spacing : spacing_.width;
        what = apart ? "the space between strands" : "the width of strands";
    }
    if (!(texel > 0.0)) return {without_strands_px, "no strands to go by"};
    const double wanted_px = std::ceil(side / texel / step_px) * step_px;
    const int size_px = int(std::clamp(wanted_px, double(smallest_px), double(largest_px)));
    return {size_px, reason(what, texel)};
}

void MapSizeRule::update(const Scene& scene) {
    std::vector<Revision> now;
    for (const ShapePtr& shape : scene.shapes()) {
        const auto lock = shape->lock();
        const Shape::Revisions& part = shape->revisions();
        now.insert(now.end(), {part.geometry, part.transform, part.opacity, part.flags});
    }
    if (now != measured_) spacing_ = measure(scene);
    measured_ = std::move(now);
}

}  // namespace opacity
