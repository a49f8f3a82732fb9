// Spheres of constant density: smoke, dust, foliage seen from afar.
#pragma once

#include <vector>

#include "opacity/scene/shape.hpp"

namespace opacity {

class Particles : public Shape {
   public:
    // Radius in the shape's units and opacity through the centre: one for all, or one a particle.
    // What a ray along a chord meets is optical depth in proportion to the chord's length.
    explicit Particles(Positions centers, std::vector<float> radius = {1.f},
                       std::vector<float> opacity = {0.1f},
                       std::vector<float3> color = {{0.8f, 0.8f, 0.8f}});

    ShapePtr instance() const override;
    double margin() const override { return max_radius_; }
    const char* kind() const override { return "particles"; }
    bool opaque() const override { return false; }

    const std::vector<float>& radius() const { return *radius_; }
    void set_radius(std::vector<float> radius);

   private:
    Particles(const Particles&) = default;
    void assign_radius(std::vector<float> radius);

    Shared<std::vector<float>> radius_;
    float max_radius_ = 0.f;
};

}  // namespace opacity
