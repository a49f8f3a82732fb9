// A light at infinity.
#pragma once

#include "opacity/core/math.hpp"

namespace opacity {

class DirectionalLight {
   public:
    // The direction in which light travels (any length but 0); colour linear RGB and intensity,
    // its factor, in [0, 1e9].
    explicit DirectionalLight(double3 direction = {0.5, 0.3, -0.8}, float3 color = {1.f, 1.f, 1.f},
                              float intensity = 1.f);

    const double3& direction() const { return direction_; }  // of length 1
    const float3& color() const { return color_; }
    float intensity() const { return intensity_; }
    void set_direction(double3 direction);
    void set_color(float3 color);
    void set_intensity(float intensity);

   private:
    double3 direction_;
    float3 color_;
    float intensity_;
};

}  // namespace opacity
