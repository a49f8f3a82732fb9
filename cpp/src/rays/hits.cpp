#include "rays/hits.hpp"

#include <algorithm>
#include <cmath>

#include "rays/crossing.hpp"

namespace opacity::rays {
namespace {

// -log(1 - opacity); opacity 1 on what is not an opaque mesh is the next smaller float32.
double optical_depth(double opacity) {
    return -std::log1p(-std::min(opacity, 1.0 - 0x1p-24));
}

}  // namespace

void Hits::start(const Ray& ray, double bias) {
    ray_ = ray;
    bias_ = bias;
    blocked_ = false;
    hits_.clear();
}

bool Hits::visit(std::uint32_t primitive) {
    const auto segments = std::uint32_t(casters_.segments.size());
    if (primitive < segments) {
        if (touches(casters_, ray_, primitive)) hits_.push_back({primitive, 0.0});
        return true;
    }
    const auto crossing = cross_triangle(casters_, ray_, primitive - segments);
    if (!crossing || !(crossing->distance > bias_)) return true;
    blocked_ = primitive - segments >= casters_.first_opaque;
    hits_.push_back({primitive, crossing->opacity});
    return !blocked_;
}

// Each stretch once, although each of its segments may have been found.
double Hits::optical_depth_of_strands(std::size_t& next) const {
    double sum = 0.0;
    while (next < hits_.size() && hits_[next].primitive < casters_.segments.size()) {
        const Stretch stretch = stretch_around(casters_, ray_, hits_[next].primitive);
        if (stretch.crossing && stretch.crossing->distance > bias_)
            sum += optical_depth(stretch.crossing->opacity);
        while (next < hits_.size() && hits_[next].primitive <= stretch.last) ++next;
    }
    return sum;
}

double Hits::transmittance() {
    if (blocked_) return 0.0;
    std::sort(hits_.begin(), hits_.end(),
              [](const Hit& a, const Hit& b) { return a.primitive < b.primitive; });
    std::size_t next = 0;
    double sum = optical_depth_of_strands(next);
    for (std::size_t i = next; i < hits_.size(); ++i)
        if (i == next || hits_[i].primitive != hits_[i - 1].primitive)
            sum += optical_depth(hits_[i].opacity);
    return std::exp(-sum);
}

}  // namespace opacity::rays
