// A volume as rays pass it: extinction, constant within a voxel, along each voxel's own chord.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "core/matrix3.hpp"
#include "opacity/scene/volume.hpp"
#include "rays/frame.hpp"
#include "rays/ray.hpp"

namespace opacity::rays {

class Voxels {
   public:
    // `volume` is nobody else's: its content stays.
    Voxels(std::shared_ptr<const Volume> volume, const Frame& frame);

    const Box& bounds() const { return bounds_; }  // in the frame
    double optical_depth(const Ray& ray, const Span& span) const;

   private:
    using Index = std::array<int, 3>;  // along x, y, z

    void find_empty_bricks();
    std::size_t brick_of(const Index& voxel) const;
    double extinction(const Index& voxel) const;

    std::shared_ptr<const Volume> volume_;
    Index size_{}, brick_count_{};
    double3x3 voxels_from_frame_{};  // about the middle of the box
    double3 center_{};               // in the frame
    Box bounds_;
    std::vector<std::uint8_t> is_empty_;  // of each brick
};

}  // namespace opacity::rays
