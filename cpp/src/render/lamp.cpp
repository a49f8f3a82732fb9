#include "render/lamp.hpp"

#include <cmath>
#include <numbers>

namespace opacity::render {
namespace {

template <class Vector>
std::vector<float> floats(const Vector& v, double factor = 1.0) {
    return {float(v[0] * factor), float(v[1] * factor), float(v[2] * factor)};
}

// The fade of a spot light in cosines of the angle to its axis: 0 at the first, 1 at the second.
std::vector<float> cone(const SpotLight& spot) {
    const double half = spot.angle_deg() * std::numbers::pi / 360.0;
    const double outer = std::cos(half), inner = std::cos(half * (1.0 - spot.softness()));
    // Without softness the edge is one step of a float wide.
    return {float(outer), float(std::max(inner, outer + 1e-6))};
}

double3 turned(const double4x4& view_from_world, const double3& v) {
    double3 result{};
    for (int row = 0; row < 3; ++row)
        for (int i = 0; i < 3; ++i) result[row] += view_from_world[4 * row + i] * v[i];
    return result;
}

}  // namespace

Uniforms lamp_uniforms(const Light* light, const double4x4& view_from_world) {
    if (!light)
        return {{"u_to_light_ws", std::vector<float>{0.f, 0.f, 1.f}},
                {"u_light_color", std::vector<float>{0.f, 0.f, 0.f}}};
    Uniforms uniforms{{"u_light_color", floats(light->color(), light->intensity())}};
    if (const auto* directional = dynamic_cast<const DirectionalLight*>(light))
        uniforms.emplace_back("u_to_light_ws", floats(directional->direction(), -1.0));
    if (const auto* positional = dynamic_cast<const PositionalLight*>(light)) {
        const Attenuation& by = positional->attenuation();
        uniforms.emplace_back("u_light_position_vs",
                              floats(transform_point(view_from_world, positional->position())));
        uniforms.emplace_back(
            "u_light_attenuation",
            std::vector<float>{float(by.constant), float(by.linear), float(by.quadratic)});
    }
    if (const auto* spot = dynamic_cast<const SpotLight*>(light)) {
        uniforms.emplace_back("u_light_axis_vs",
                              floats(turned(view_from_world, spot->direction())));
        uniforms.emplace_back("u_light_cone", cone(*spot));
    }
    return uniforms;
}

Defines lamp_defines(const Light* light) {
    Defines defines;
    if (dynamic_cast<const PositionalLight*>(light)) defines.emplace_back("POSITIONAL_LIGHT", "1");
    if (dynamic_cast<const SpotLight*>(light)) defines.emplace_back("SPOT_LIGHT", "1");
    return defines;
}

}  // namespace opacity::render
