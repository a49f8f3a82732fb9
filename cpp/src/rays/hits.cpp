#include "rays/hits.hpp"

#include <algorithm>
#include <cmath>

#include "rays/crossing.hpp"

namespace opacity::rays {

void Hits::start(const Ray& ray, const Span& span, std::uint32_t own) {
    ray_ = ray;
    span_ = span;
    own_ = own;
    blocked_ = false;
    hits_.clear();
}

bool Hits::visit(std::uint32_t primitive) {
    if (primitive == own_) return true;
    const auto [kind, index] = casters_.primitive(primitive);
    switch (kind) {
        case Kind::segment:
            if (touches(casters_, ray_, index)) hits_.push_back({primitive, 0.0});
            return true;
        case Kind::triangle:
            return visit_triangle(primitive, index);
        case Kind::sphere:
            hits_.push_back(
                {primitive, optical_depth_through(casters_.spheres[index], ray_, span_)});
            return true;
        case Kind::volume:
            hits_.push_back({primitive, casters_.volumes[index].optical_depth(ray_, span_)});
            return true;
    }
    return true;
}

bool Hits::visit_triangle(std::uint32_t primitive, std::uint32_t triangle) {
    const auto crossing = cross_triangle(casters_, ray_, triangle);
    if (!crossing || !crossing->is_within(span_)) return true;
    blocked_ = triangle >= casters_.first_opaque;
    hits_.push_back({primitive, crossing->optical_depth});
    return !blocked_;
}

// Each stretch once, although each of its segments may have been found.
double Hits::optical_depth_of_strands(std::size_t& next) const {
    double sum = 0.0;
    while (next < hits_.size() && hits_[next].primitive < casters_.segments.size()) {
        const Stretch stretch = stretch_around(casters_, ray_, hits_[next].primitive);
        if (stretch.crossing && stretch.crossing->is_within(span_))
            sum += stretch.crossing->optical_depth;
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
            sum += hits_[i].optical_depth;
    return std::exp(-sum);
}

}  // namespace opacity::rays
