// Hair, fur, grass: polylines with a width, drawn as ribbons that face whoever looks.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "opacity/scene/shape.hpp"

namespace opacity {

struct StrandRanks;

class Strands : public Shape {
   public:
    // Strand k is points[offsets[k]] .. points[offsets[k + 1] - 1], root to tip; offsets start at
    // 0, never fall, and end at the number of points. Width in the shape's units: one for all, or
    // one a point.
    Strands(Positions points, std::vector<std::int64_t> offsets, std::vector<float> width = {0.1f},
            std::vector<float> opacity = {0.3f}, std::vector<float3> color = {{0.6f, 0.4f, 0.25f}});

    double margin() const override { return 0.5 * max_width_; }
    const char* kind() const override { return "strands"; }
    bool opaque() const override { return false; }

    const std::vector<std::int64_t>& offsets() const { return *offsets_; }
    const std::vector<float>& width() const { return *width_; }
    void set_width(std::vector<float> width);

    std::size_t strand_count() const { return offsets_->size() - 1; }
    // The first point of every segment: a segment joins points[i] and points[i + 1] of one strand.
    const std::vector<std::uint32_t>& segments() const { return *segments_; }
    // Which of them a map that holds fewer leaves out first; found when first asked for, and the
    // same for all instances, while points move too. With the lock held.
    std::shared_ptr<const StrandRanks> ranks() const;
    float mean_width() const { return mean_width_; }
    double strand_width() const override { return mean_width_ * scale(); }

   private:
    Strands(const Strands&) = default;
    ShapePtr clone() const override { return ShapePtr{new Strands{*this}}; }
    void assign_width(std::vector<float> width);

    Shared<std::vector<std::int64_t>> offsets_;
    Shared<std::vector<float>> width_;
    Shared<std::vector<std::uint32_t>> segments_;
    struct RankSlot;
    std::shared_ptr<RankSlot> ranks_;
    float max_width_ = 0.f, mean_width_ = 0.f;
};

}  // namespace opacity
