// The primitives of a shape in chunks of neighbours with a box each, so that a view leaves out what
// it cannot see, chunk by chunk.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

#include "opacity/scene/shape.hpp"

namespace opacity {

struct PrimitiveChunks {
    static constexpr std::size_t size = 512;  // primitives; the last one may have fewer

    // Primitives by number, one chunk after the other: along a curve of Morton (1966) through the
    // middles that they had when the shape was first cut. Kept while points move, since neighbours
    // stay neighbours; the revision tells one order from another.
    std::shared_ptr<const std::vector<std::uint32_t>> order;
    Revision order_revision = 0;
    // Of the points of each, without widths, in the shape's coordinates; none of a volume.
    std::vector<Box> boxes;
    Revision geometry = 0;

    std::size_t count() const { return boxes.size(); }
    // The place in the order of a chunk's first primitive; of the one behind the last: their
    // number.
    std::size_t first(std::size_t chunk) const { return std::min(chunk * size, order->size()); }
};

// With the shape's lock held. `last`: the chunks that it had before, or none.
PrimitiveChunks chunks_of(const Shape& shape, const PrimitiveChunks* last);

// What the instances of a shape share while none of them moves its points.
struct ChunkSlot {
    std::mutex mutex;
    std::shared_ptr<const PrimitiveChunks> chunks;  // none: not asked for yet
};

}  // namespace opacity
