// Which indices a pass draws of a shape: the chunks that its view sees, in the order in which they
// are stored, or from buffers of their own for passes that draw primitives in another order, or
// only some of them.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include "gl/buffer.hpp"
#include "opacity/graph/pass.hpp"
#include "render/gpu_shapes.hpp"

namespace opacity::render {

struct IndexRange {
    std::size_t first = 0, count = 0;
};
struct Indices {
    unsigned buffer, primitives;  // vertices; and the numbers of the primitives that have them
    std::vector<IndexRange> ranges;
};

class PrimitiveOrders {
   public:
    explicit PrimitiveOrders(std::shared_ptr<gl::Context> context) : context_{std::move(context)} {}
    // For the pass's selection of a shape's primitives, made again when the shape or, for an order,
    // the view has moved. A volume is one primitive.
    Indices indices(const Pass& pass, const ShapePtr& shape, const GpuShape& gpu);
    // Frees the buffers of shapes that are gone, and those that no pass wanted for long. Once a
    // frame.
    void collect();

   private:
    struct Made {
        std::weak_ptr<const Shape> shape;
        Revision geometry = 0;
        double4x4 view_from_local{};
        ChunkRanges seen;
        std::optional<gl::Buffer> buffer, primitives;
        std::vector<std::size_t> chunk_firsts;  // and the end
        int frames_unused = 0;
    };
    const Made& back_to_front(const Pass& pass, const ShapePtr& shape, const ChunkRanges& seen);
    const Made& part(const Selection& selection, double detail, const ShapePtr& shape);
    void fill(Made& made, const Shape& shape, const std::vector<std::uint32_t>& primitives) const;

    std::shared_ptr<gl::Context> context_;
    // By shape, part, and the part of the strands; the whole in an order is part -1.
    std::map<std::tuple<const Shape*, int, double>, Made> made_;
};

}  // namespace opacity::render
