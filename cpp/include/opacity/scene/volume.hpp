// A box of voxels that take light away: smoke, clouds.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "opacity/scene/shape.hpp"

namespace opacity {

class Volume : public Shape {
   public:
    // The number of voxels along z, y, x.
    using Size = std::array<int, 3>;

    // Extinction, constant within a voxel, x fastest: optical depth per unit of length in the
    // shape's coordinates, so that a transform which scales keeps what the whole lets through.
    // `origin` is the middle of the first voxel, `spacing` the distance to the next ones along x, y
    // and z.
    Volume(Size size_zyx, std::vector<float> extinction, double3 origin = {0, 0, 0},
           double3 spacing = {1, 1, 1}, float3 color = {0.8f, 0.8f, 0.8f});

    const char* kind() const override { return "volume"; }
    bool opaque() const override { return false; }
    bool invisible_to_light() const override { return max_extinction_ == 0.f; }

    const Size& size_zyx() const { return size_zyx_; }
    std::size_t voxel_count() const { return extinction_->size(); }
    const std::vector<float>& extinction() const { return *extinction_; }
    void set_extinction(std::vector<float> extinction);  // as many voxels as before
    // Of red, green and blue light; extinction() is then their mean.
    void set_extinction_rgb(const std::vector<float3>& rgb);
    float max_extinction() const { return max_extinction_; }

    const double3& origin() const { return origin_; }
    const double3& spacing() const { return spacing_; }
    void set_grid(double3 origin, double3 spacing);
    // Of its voxels in the shape's coordinates; its corners are the shape's points.
    Box box() const { return point_bounds_; }
    // The middle of a voxel, in the shape's coordinates.
    double3 voxel_center(std::size_t index) const;

   private:
    Volume(const Volume&) = default;
    ShapePtr clone() const override { return ShapePtr{new Volume{*this}}; }
    void show(const Tint::Channel& channel) override;
    void check_extinction(std::span<const float> values, std::size_t channels) const;
    void assign_extinction(Shared<std::vector<float>> extinction);
    void check_points_are_settable() const override;

    Size size_zyx_;
    Shared<std::vector<float>> extinction_;
    double3 origin_, spacing_;
    float max_extinction_ = 0.f;
};

}  // namespace opacity
