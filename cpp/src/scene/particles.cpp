#include "opacity/scene/particles.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include "opacity/core/error.hpp"
#include "scene/check.hpp"

namespace opacity {
namespace {

constexpr std::array<const char*, 2> profile_names{"sphere", "metaball"};

}  // namespace

const char* to_string(DensityProfile profile) {
    return profile_names[std::size_t(profile)];
}

DensityProfile density_profile(std::string_view name) {
    const auto found = std::find(profile_names.begin(), profile_names.end(), name);
    if (found == profile_names.end())
        throw ParameterError("profile = \"" + std::string{name} + "\" is not known",
                             "choose \"sphere\" or \"metaball\"");
    return DensityProfile(found - profile_names.begin());
}

Particles::Particles(Positions centers, std::vector<float> radius, std::vector<float> opacity,
                     std::vector<float3> color, DensityProfile profile)
    : Shape{std::move(centers), std::move(opacity), std::move(color)}, profile_{profile} {
    assign_radius(std::move(radius));
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

void Particles::set_profile(DensityProfile profile) {
    const auto held = lock();
    if (std::exchange(profile_, profile) != profile) revisions_.geometry = next_revision();
}

}  // namespace opacity
