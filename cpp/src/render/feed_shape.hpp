// From a shape's buffers to a view: the transform, the view and the origin of the points, joined in
// float64.
#pragma once

#include "opacity/graph/pass.hpp"
#include "render/gpu_shapes.hpp"
#include "render/program_feeder.hpp"

namespace opacity::render {

// Feeds everything that is the shape's own: its buffers and textures as far as the pass declared
// them, strides, scale, flags, and for the pass's view and every view among its reads the matrices
// u_<view>_from_local and u_<view>_normal_from_local, and what the view sees of strands,
// u_<view>_strand_detail and u_<view>_strand_widening; of a volume also u_<view>_from_voxels and
// u_voxels_from_<view>, where a voxel is one unit long.
void feed_shape(ProgramFeeder& feeder, const Pass& pass, const GpuShape& gpu);

}  // namespace opacity::render
