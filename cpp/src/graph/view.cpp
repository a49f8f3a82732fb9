#include "opacity/graph/view.hpp"

#include "scene/primitive_chunks.hpp"
#include "scene/strand_ranks.hpp"

namespace opacity {
namespace {

// What has no primitives is one chunk: its whole box.
std::vector<Box> boxes_of(const Shape& shape) {
    std::vector<Box> boxes = shape.chunks()->boxes;
    if (boxes.empty()) boxes.push_back(shape.local_bounds());
    return boxes;
}

}  // namespace

void append_chunk(ChunkRanges& ranges, std::size_t chunk) {
    if (ranges.empty() || ranges.back().end != chunk)
        ranges.push_back({chunk, chunk + 1});
    else
        ++ranges.back().end;
}

void View::cull(const std::vector<ShapePtr>& shapes, const IsOut& is_out) {
    std::erase_if(seen_, [](const auto& entry) { return entry.second.shape.expired(); });
    for (const ShapePtr& shape : shapes) {
        const auto lock = shape->lock();
        Seen& seen = seen_[shape.get()];
        const Shape::Revisions& now = shape->revisions();
        if (seen.shape.lock() == shape && seen.geometry == now.geometry &&
            seen.transform == now.transform && seen.view == revision())
            continue;
        seen = {shape, now.geometry, now.transform, revision(), {}, {}};
        const double reach = caster_reach(*shape, strand_detail_);
        for (const Box& box : boxes_of(*shape)) {
            if (is_out(box.transformed(shape->transform()), reach))
                ++seen.count.hidden;
            else
                append_chunk(seen.ranges, seen.count.all);
            ++seen.count.all;
        }
    }
}

const ChunkRanges* View::seen(const Shape& shape) const {
    const auto found = seen_.find(&shape);
    return found == seen_.end() ? nullptr : &found->second.ranges;
}

View::ChunkCount View::chunks(const std::vector<ShapePtr>& shapes) const {
    ChunkCount sum;
    for (const ShapePtr& shape : shapes)
        if (const auto found = seen_.find(shape.get()); found != seen_.end()) {
            sum.all += found->second.count.all;
            sum.hidden += found->second.count.hidden;
        }
    return sum;
}

}  // namespace opacity
