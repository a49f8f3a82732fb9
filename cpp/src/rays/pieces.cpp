#include "rays/pieces.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

namespace opacity::rays {
namespace {

// Measured on straight.hair: 2.5 times as many boxes, a third of their area; rays take half the
// time, sorting twice as long. With half the size again sorting takes longer than rays save.
constexpr double widths_a_piece = 8.0;
constexpr int most_pieces = 16;

Piece piece(const Box& box, std::uint32_t primitive) {
    Piece result{{}, {}, primitive};
    for (std::size_t i = 0; i < 3; ++i) {
        result.min[i] = float(box.min[i] - box_margin);
        result.max[i] = float(box.max[i] + box_margin);
    }
    return result;
}

// By the side of its box that least keeps rays away: a segment along an axis fills its box. Rays
// along the z axis see two sides of it, others three.
int count_of(const Vertex& a, const Vertex& b, bool parallel) {
    double3 side{};
    for (std::size_t i = 0; i < 3; ++i) side[i] = std::abs(a.position[i] - b.position[i]);
    if (!parallel) std::sort(side.begin(), side.end(), std::greater<>{});
    const double wanted = std::min(side[0], side[1]) /
                          (2.0 * widths_a_piece * std::max({a.half_width, b.half_width, 1e-6}));
    return int(std::clamp(std::ceil(wanted), 1.0, double(most_pieces)));
}

Vertex between(const Vertex& a, const Vertex& b, double along) {
    Vertex result = a;
    for (std::size_t i = 0; i < 3; ++i)
        result.position[i] = std::lerp(a.position[i], b.position[i], along);
    result.half_width = std::max(a.half_width, b.half_width);
    return result;
}

}  // namespace

std::vector<Piece> pieces_of(const Casters& casters) {
    std::vector<Piece> pieces;
    pieces.reserve(casters.primitive_count());
    for (std::uint32_t i = 0; i < casters.primitive_count(); ++i) {
        if (i >= casters.segments.size()) {
            pieces.push_back(piece(casters.bounds_of(i), i));
            continue;
        }
        const Vertex* vertex = &casters.vertices[casters.segments[i]];
        const int count = count_of(vertex[0], vertex[1], casters.parallel);
        for (int k = 0; k < count; ++k) {
            Box box;
            for (const int end : {k, k + 1}) {
                const Vertex v = between(vertex[0], vertex[1], double(end) / count);
                box.extend(Box{v.position, v.position}.padded(v.half_width));
            }
            pieces.push_back(piece(box, i));
        }
    }
    return pieces;
}

}  // namespace opacity::rays
