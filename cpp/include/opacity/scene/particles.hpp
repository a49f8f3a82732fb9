// Round clouds, of constant density or denser toward their middle: smoke, dust, foliage seen from
// afar.
#pragma once

#include <string_view>
#include <vector>

#include "opacity/scene/shape.hpp"

namespace opacity {

// How density falls with r, the distance from a particle's middle in radii: not at all up to the
// surface; or as (1 - r^2)^2, so that nothing shows where it ends.
enum class DensityProfile { sphere, metaball };

const char* to_string(DensityProfile profile);
DensityProfile density_profile(std::string_view name);  // ParameterError for a name that is none

class Particles : public Shape {
   public:
    // Radius in the shape's units and opacity through the centre: one for all, or one a particle.
    explicit Particles(Positions centers, std::vector<float> radius = {1.f},
                       std::vector<float> opacity = {0.1f},
                       std::vector<float3> color = {{0.8f, 0.8f, 0.8f}},
                       DensityProfile profile = DensityProfile::sphere);

    double margin() const override { return max_radius_; }
    const char* kind() const override { return "particles"; }
    bool opaque() const override { return false; }

    const std::vector<float>& radius() const { return *radius_; }
    void set_radius(std::vector<float> radius);
    DensityProfile profile() const { return profile_; }
    void set_profile(DensityProfile profile);

   private:
    Particles(const Particles&) = default;
    ShapePtr clone() const override { return ShapePtr{new Particles{*this}}; }
    void assign_radius(std::vector<float> radius);

    Shared<std::vector<float>> radius_;
    float max_radius_ = 0.f;
    DensityProfile profile_;
};

}  // namespace opacity
