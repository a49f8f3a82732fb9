#include "opacity/scene/light.hpp"

#include <algorithm>
#include <cmath>

#include "opacity/core/error.hpp"
#include "scene/check.hpp"

namespace opacity {
namespace {

constexpr Allowed map_size_range{0, 16384, "in 0..16384"};
constexpr Allowed cone_angle{1.0, 170.0, "in 1..170 degrees"};
constexpr Allowed sample_count{1, 8, "in 1..8"};
constexpr Allowed attenuation_range{0.0, 1e30, "in 0..1e30"};

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

Light::Light(float3 color, float intensity) {
    set_color(color);
    set_intensity(intensity);
}

void Light::set_color(float3 color) {
    check_values("light color", color, brightness);
    color_ = color;
}

void Light::set_intensity(float intensity) {
    check_value("light intensity", intensity, brightness);
    intensity_ = intensity;
}

void Light::set_map_size(int map_size_px) {
    check_value("light map_size", double(map_size_px), map_size_range);
    map_size_ = map_size_px;
}

DirectionalLight::DirectionalLight(double3 direction, float3 color, float intensity)
    : Light{color, intensity} {
    set_direction(direction);
}

void DirectionalLight::set_direction(double3 direction) {
    direction_ = unit(direction);
}

PositionalLight::PositionalLight(double3 position, float3 color, float intensity)
    : Light{color, intensity} {
    set_position(position);
}

void PositionalLight::set_position(double3 position) {
    check_vector("light position", position);
    position_ = position;
}

void PositionalLight::set_attenuation(const Attenuation& attenuation) {
    const auto& [constant, linear, quadratic] = attenuation;
    check_value("attenuation constant", constant, attenuation_range);
    check_value("attenuation linear", linear, attenuation_range);
    check_value("attenuation quadratic", quadratic, attenuation_range);
    if (constant == 0.0 && linear == 0.0 && quadratic == 0.0)
        throw ParameterError("attenuation = (0, 0, 0) divides by 0",
                             "pass (1, 0, 0) for none, (0, 0, 1) for the square of the distance");
    attenuation_ = attenuation;
}

SpotLight::SpotLight(double3 position, double3 direction, double angle_deg, float3 color,
                     float intensity)
    : PositionalLight{position, color, intensity} {
    set_direction(direction);
    set_angle_deg(angle_deg);
}

void SpotLight::set_direction(double3 direction) {
    direction_ = unit(direction);
}

void SpotLight::set_angle_deg(double angle_deg) {
    check_value("angle_deg", angle_deg, cone_angle);
    angle_deg_ = angle_deg;
}

void SpotLight::set_softness(double softness) {
    check_value("softness", softness, unit_interval);
    softness_ = softness;
}

AreaLight::AreaLight(double3 position, double3 edge_u, double3 edge_v, int samples, float3 color,
                     float intensity)
    : PositionalLight{position, color, intensity} {
    set_edges(edge_u, edge_v);
    set_samples(samples);
}

void AreaLight::set_edges(double3 edge_u, double3 edge_v) {
    check_vector("edge_u", edge_u);
    check_vector("edge_v", edge_v);
    edge_u_ = edge_u;
    edge_v_ = edge_v;
}

void AreaLight::set_samples(int samples) {
    check_value("samples", double(samples), sample_count);
    samples_ = samples;
}

std::vector<double3> light_points(const Light& light) {
    const auto* positional = dynamic_cast<const PositionalLight*>(&light);
    if (!positional) return {};
    const auto* area = dynamic_cast<const AreaLight*>(&light);
    if (!area) return {positional->position()};
    const int n = area->samples();
    std::vector<double3> points;
    for (int row = 0; row < n; ++row)
        for (int column = 0; column < n; ++column) {
            const double u = (column + 0.5) / n - 0.5, v = (row + 0.5) / n - 0.5;
            double3 p = area->position();
            for (int axis = 0; axis < 3; ++axis)
                p[axis] += u * area->edge_u()[axis] + v * area->edge_v()[axis];
            points.push_back(p);
        }
    return points;
}

}  // namespace opacity
