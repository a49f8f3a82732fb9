#include "render/primitive_indices.hpp"

namespace opacity::render {
namespace {

void append_quad(std::vector<std::uint32_t>& indices, std::uint32_t number) {
    const std::uint32_t c = 4 * number;
    indices.insert(indices.end(), {c, c + 1, c + 2, c, c + 2, c + 3});
}

}  // namespace

std::vector<std::uint32_t> indices_of(const Primitives& primitives,
                                      const std::vector<std::uint32_t>& numbers) {
    std::vector<std::uint32_t> indices;
    indices.reserve(numbers.size() * primitives.indices_each());
    for (const std::uint32_t i : numbers) {
        if (primitives.corners() != 3) {
            append_quad(indices, i);
            continue;
        }
        for (std::size_t corner = 0; corner < 3; ++corner)
            indices.push_back(primitives.point(i, corner));
    }
    return indices;
}

std::vector<std::uint32_t> quad_triangles(std::size_t count) {
    std::vector<std::uint32_t> indices;
    indices.reserve(6 * count);
    for (std::uint32_t i = 0; i < count; ++i) append_quad(indices, i);
    return indices;
}

}  // namespace opacity::render
