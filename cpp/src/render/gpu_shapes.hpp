// The buffers of each shape, uploaded again only when the part that they hold has changed.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <utility>

#include "gl/buffer.hpp"
#include "opacity/scene/shape.hpp"

namespace opacity::render {

// One part of a shape in the device's memory, and the revision that it was made from.
struct GpuPart {
    Revision revision = 0;
    std::optional<gl::Buffer> buffer;
};

struct GpuShape {
    std::weak_ptr<const Shape> shape;
    double3 origin{};  // what was subtracted from the points, in float64
    GpuPart points, segments, triangles, normals, opacity, color;
    int segment_count = 0, index_count = 0;
    int opacity_stride = 0, color_stride = 0;
    // Copied while the shape is locked, so that another thread may move it meanwhile.
    double4x4 transform = identity;
    float width_scale = 1.f;
    float receiver_width = 0.f;  // world units; 0 for a surface
    bool receives = true, opaque = false;
    bool deposits = false;  // whether the opacity maps hold it
};

class GpuShapes {
   public:
    explicit GpuShapes(std::shared_ptr<gl::Context> context) : context_{std::move(context)} {}
    // The shape's buffers, brought up to date.
    const GpuShape& upload(const ShapePtr& shape);
    // Frees the buffers of shapes that are gone.
    void collect();

   private:
    void upload_geometry(GpuShape& gpu, const Shape& shape) const;
    void upload_appearance(GpuShape& gpu, const Shape& shape) const;

    std::shared_ptr<gl::Context> context_;
    std::map<const Shape*, GpuShape> shapes_;
};

}  // namespace opacity::render
