#include "opacity/scene/light.hpp"

#include <algorithm>
#include <cmath>

#include "opacity/core/error.hpp"
#include "scene/check.hpp"

namespace opacity {
namespace {

double3 unit(double3 direction) {
    check_vector("light direction", direction);
    const double largest =
        std::max({std::abs(direction[0]), std::abs(direction[1]), std::abs(direction[2])});
    if (largest == 0.0)
        throw ParameterError("light direction = (0, 0, 0)",
                             "pass the direction in which light travels, such as (0.5, 0.3, -0.8)");
    // Scaled first: the squares of a tiny direction would be 0.
    for (double& c : direction) c /= largest;
    const double length = std::hypot(direction[0], direction[1], direction[2]);
    for (double& c : direction) c /= length;
    return direction;
}

}  // namespace

DirectionalLight::DirectionalLight(double3 direction, float3 color, float intensity) {
    set_direction(direction);
    set_color(color);
    set_intensity(intensity);
}

void DirectionalLight::set_direction(double3 direction) {
    direction_ = unit(direction);
}

void DirectionalLight::set_color(float3 color) {
    check_values("light color", color, brightness);
    color_ = color;
}

void DirectionalLight::set_intensity(float intensity) {
    check_value("light intensity", intensity, brightness);
    intensity_ = intensity;
}

}  // namespace opacity
