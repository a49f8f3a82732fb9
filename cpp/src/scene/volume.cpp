#include "opacity/scene/volume.hpp"

#include <algorithm>
#include <string>

#include "core/number_text.hpp"
#include "opacity/core/error.hpp"
#include "scene/check.hpp"

namespace opacity {
namespace {

constexpr int most_voxels_a_side = 2048;  // what OpenGL guarantees of a 3-D texture

void check_size(const Volume::Size& size_zyx) {
    for (std::size_t i = 0; i < 3; ++i)
        if (size_zyx[i] < 1 || size_zyx[i] > most_voxels_a_side)
            throw ParameterError(
                "the volume has " + std::to_string(size_zyx[i]) + " voxels along " + "zyx"[i],
                "pass 1 .. " + std::to_string(most_voxels_a_side) +
                    "; split a larger volume into several");
}

void check_grid(const double3& origin, const double3& spacing) {
    check_vector("origin", origin);
    check_vector("spacing", spacing);
    for (std::size_t i = 0; i < 3; ++i)
        if (!(spacing[i] > 0.0))
            throw ParameterError(
                std::string{"spacing."} + "xyz"[i] + " = " + number_text(spacing[i]),
                "pass distances above 0 between the middles of neighbouring voxels");
}

// The eight corners of all voxels.
Positions corners(const Volume::Size& size_zyx, const double3& origin, const double3& spacing) {
    std::vector<double> xyz;
    for (int corner = 0; corner < 8; ++corner)
        for (int axis = 0; axis < 3; ++axis) {
            const int voxels = corner >> axis & 1 ? size_zyx[std::size_t(2 - axis)] : 0;
            xyz.push_back(origin[axis] + (voxels - 0.5) * spacing[axis]);
        }
    return Positions{std::move(xyz)};
}

Positions checked_corners(const Volume::Size& size_zyx, const double3& origin,
                          const double3& spacing) {
    check_size(size_zyx);
    check_grid(origin, spacing);
    return corners(size_zyx, origin, spacing);
}

}  // namespace

Volume::Volume(Size size_zyx, std::vector<float> extinction, double3 origin, double3 spacing,
               float3 color)
    : Shape{checked_corners(size_zyx, origin, spacing), {1.f}, {color}},
      size_zyx_{size_zyx},
      origin_{origin},
      spacing_{spacing} {
    check_extinction(extinction, 1);
    assign_extinction(std::move(extinction));
}

void Volume::check_extinction(std::span<const float> values, std::size_t channels) const {
    const std::size_t count = std::size_t(size_zyx_[0]) * size_zyx_[1] * size_zyx_[2];
    if (values.size() != count * channels)
        throw ParameterError("extinction has " + std::to_string(values.size() / channels) +
                                 " values for " + std::to_string(count) + " voxels",
                             "pass one a voxel, x fastest");
    check_values("extinction", values, {0.0, 1e18, "in 0..1e18"}, channels);
}

void Volume::assign_extinction(Shared<std::vector<float>> extinction) {
    max_extinction_ = *std::max_element(extinction->begin(), extinction->end());
    extinction_ = std::move(extinction);
}

void Volume::set_extinction(std::vector<float> extinction) {
    check_extinction(extinction, 1);
    const auto held = lock();
    assign_extinction(std::move(extinction));
    tint_ = nullptr;
    revisions_.geometry = next_revision();
}

void Volume::set_extinction_rgb(const std::vector<float3>& rgb) {
    check_extinction(flat(rgb), channel_names.size());
    const auto held = lock();
    auto tint = std::make_shared<const Tint>(rgb, tint_.get());
    assign_extinction(tint->mean());
    tint_ = std::move(tint);
    revisions_.geometry = next_revision();
}

void Volume::show(const Tint::Channel& channel) {
    assign_extinction(channel.values);
    revisions_.geometry = channel.revision;
}

void Volume::set_grid(double3 origin, double3 spacing) {
    check_grid(origin, spacing);
    const auto held = lock();
    origin_ = origin;
    spacing_ = spacing;
    points_ = corners(size_zyx_, origin, spacing);
    point_bounds_ = points_.bounds();
    // A channel of it stands for the grid too: the same tint under new revisions.
    if (tint_) tint_ = std::make_shared<const Tint>(tint_->rgb());
    revisions_.geometry = next_revision();
}

double3 Volume::voxel_center(std::size_t index) const {
    const std::size_t nx = std::size_t(size_zyx_[2]), ny = std::size_t(size_zyx_[1]);
    const std::size_t x = index % nx, y = index / nx % ny, z = index / (nx * ny);
    return {origin_[0] + double(x) * spacing_[0], origin_[1] + double(y) * spacing_[1],
            origin_[2] + double(z) * spacing_[2]};
}

void Volume::check_points_are_settable() const {
    throw ParameterError("the points of a volume are the corners of its voxels",
                         "set its grid (origin and spacing) instead");
}

}  // namespace opacity
