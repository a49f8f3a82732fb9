#include "opacity/scene/particles.hpp"

#include <algorithm>

#include "scene/check.hpp"

namespace opacity {

Particles::Particles(Positions centers, std::vector<float> radius, std::vector<float> opacity,
                     std::vector<float3> color)
    : Shape{std::move(centers), std::move(opacity), std::move(color)} {
    assign_radius(std::move(radius));
}

ShapePtr Particles::instance() const {
    const auto held = lock();
    return ShapePtr{new Particles{*this}};
}

void Particles::assign_radius(std::vector<float> radius) {
    check_attribute_size("radius", radius.size());
    check_values("radius", radius, not_negative);
    max_radius_ = radius.empty() ? 0.f : *std::max_element(radius.begin(), radius.end());
    radius_ = std::move(radius);
}

void Particles::set_radius(std::vector<float> radius) {
    const auto held = lock();
    assign_radius(std::move(radius));
    revisions_.geometry = next_revision();
}

}  // namespace opacity
