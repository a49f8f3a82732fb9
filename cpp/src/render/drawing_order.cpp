#include "render/drawing_order.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "opacity/scene/strands.hpp"

namespace opacity::render {

bool keeps_nearest(const Pass& pass) {
    return pass.view->has_eye() && pass.state.depth == Depth::greater &&
           pass.state.blend == Blend::off;
}

std::vector<std::size_t> drawing_order(const Pass& pass) {
    const std::vector<ShapePtr>& shapes = pass.draws->shapes();
    std::vector<std::size_t> order(shapes.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    if (keeps_nearest(pass))
        std::stable_partition(order.begin(), order.end(), [&](std::size_t i) {
            return dynamic_cast<const Strands*>(shapes[i].get()) != nullptr;
        });
    return order;
}

ChunkRanges front_to_back(const PrimitiveChunks& chunks, const ChunkRanges& seen,
                          const double4x4& view_from_local) {
    std::vector<std::pair<double, std::size_t>> distances;
    for (const ChunkRange& range : seen)
        for (std::size_t chunk = range.begin; chunk < range.end; ++chunk) {
            const double3 p = transform_point(view_from_local, chunks.boxes[chunk].center());
            distances.emplace_back(p[0] * p[0] + p[1] * p[1] + p[2] * p[2], chunk);
        }
    std::sort(distances.begin(), distances.end());
    ChunkRanges ordered;
    for (const auto& [distance, chunk] : distances) append_chunk(ordered, chunk);
    return ordered;
}

}  // namespace opacity::render
