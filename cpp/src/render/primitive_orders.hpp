// Index buffers for passes that draw primitives in another order than they are stored in, or only
// some of them.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "gl/buffer.hpp"
#include "opacity/graph/pass.hpp"
#include "render/gpu_shapes.hpp"

namespace opacity::render {

struct Indices {
    unsigned buffer;
    int count;
};

class PrimitiveOrders {
   public:
    explicit PrimitiveOrders(std::shared_ptr<gl::Context> context) : context_{std::move(context)} {}
    // For the pass's selection of a shape's primitives, made again when the shape or, for an order,
    // the view has moved. A volume is one primitive.
    Indices indices(const Pass& pass, const ShapePtr& shape, const GpuShape& gpu);
    // Frees the buffers of shapes that are gone.
    void collect();

   private:
    struct Made {
        std::weak_ptr<const Shape> shape;
        Revision geometry = 0;
        double4x4 view_from_local{};
        std::optional<gl::Buffer> buffer;
        int count = 0;
    };
    void make(Made& made, const std::vector<std::uint32_t>& indices) const;

    std::shared_ptr<gl::Context> context_;
    // By shape and part; the whole in an order is part -1.
    std::map<std::pair<const Shape*, int>, Made> made_;
};

}  // namespace opacity::render
