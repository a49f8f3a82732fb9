#include "render/primitive_orders.hpp"

#include <algorithm>
#include <numeric>

#include "opacity/scene/strands.hpp"

namespace opacity::render {
namespace {

constexpr int ordered_whole = -1;

std::size_t primitive_count(const Shape& shape) {
    if (const auto* strands = dynamic_cast<const Strands*>(&shape))
        return strands->segments().size();
    if (const auto* mesh = dynamic_cast<const Mesh*>(&shape)) return mesh->triangles().size() / 3;
    return shape.points().size();
}

double3 middle(const Shape& shape, std::size_t primitive) {
    const auto mean = [&](std::initializer_list<std::size_t> points) {
        double3 sum{};
        for (const std::size_t i : points)
            for (int axis = 0; axis < 3; ++axis)
                sum[axis] += shape.points()[i][axis] / double(points.size());
        return sum;
    };
    if (const auto* strands = dynamic_cast<const Strands*>(&shape)) {
        const std::size_t first = strands->segments()[primitive];
        return mean({first, first + 1});
    }
    if (const auto* mesh = dynamic_cast<const Mesh*>(&shape)) {
        const std::uint32_t* corner = &mesh->triangles()[3 * primitive];
        return mean({corner[0], corner[1], corner[2]});
    }
    return shape.points()[primitive];
}

// As GpuShapes lays them out: triangles by their corners, all else two triangles over four vertices
// a primitive.
std::vector<std::uint32_t> indices_of(const Shape& shape,
                                      const std::vector<std::uint32_t>& primitives) {
    const auto* mesh = dynamic_cast<const Mesh*>(&shape);
    std::vector<std::uint32_t> indices;
    indices.reserve(primitives.size() * (mesh ? 3 : 6));
    for (const std::uint32_t i : primitives) {
        if (mesh) {
            const std::uint32_t* corner = &mesh->triangles()[3 * std::size_t(i)];
            indices.insert(indices.end(), corner, corner + 3);
            continue;
        }
        const std::uint32_t c = 4 * i;
        indices.insert(indices.end(), {c, c + 1, c + 2, c, c + 2, c + 3});
    }
    return indices;
}

// By the distance of the eye to their middles; equally far ones stay as they are stored.
std::vector<std::uint32_t> back_to_front(const Shape& shape, const double4x4& view_from_local) {
    std::vector<float> distance(primitive_count(shape));
    for (std::size_t i = 0; i < distance.size(); ++i) {
        const double3 p = transform_point(view_from_local, middle(shape, i));
        distance[i] = float(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
    }
    std::vector<std::uint32_t> order(distance.size());
    std::iota(order.begin(), order.end(), 0u);
    std::stable_sort(order.begin(), order.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return distance[a] > distance[b]; });
    return order;
}

// Whole strands, which would show gaps otherwise.
std::vector<std::uint32_t> part_of(const Shape& shape, const Selection& selection) {
    std::vector<std::uint32_t> primitives;
    const auto* strands = dynamic_cast<const Strands*>(&shape);
    const std::size_t count = primitive_count(shape);
    std::size_t strand = 0;
    for (std::size_t i = 0; i < count; ++i) {
        if (strands)
            while (std::int64_t(strands->segments()[i]) >= strands->offsets()[strand + 1]) ++strand;
        const std::size_t number = strands ? strand : i;
        if (int(number % std::size_t(selection.parts)) == selection.part)
            primitives.push_back(std::uint32_t(i));
    }
    return primitives;
}

double4x4 product(const double4x4& a, const double4x4& b) {
    double4x4 result{};
    for (int row = 0; row < 4; ++row)
        for (int column = 0; column < 4; ++column)
            for (int k = 0; k < 4; ++k)
                result[4 * row + column] += a[4 * row + k] * b[4 * k + column];
    return result;
}

}  // namespace

Indices PrimitiveOrders::indices(const Pass& pass, const ShapePtr& shape, const GpuShape& gpu) {
    const Selection& selection = pass.state.selection;
    const bool is_volume = gpu.extinction.object != nullptr;
    if (selection == Selection{} || is_volume) return {gpu.indices.object->name(), gpu.index_count};
    const bool ordered = selection.back_to_front;
    Made& made = made_[{shape.get(), ordered ? ordered_whole : selection.part}];
    const auto lock = shape->lock();
    const double4x4 view_from_local =
        ordered ? product(pass.view->from_world(), shape->transform()) : double4x4{};
    const bool is_current = made.shape.lock() == shape && made.buffer &&
                            made.geometry == shape->revisions().geometry &&
                            made.view_from_local == view_from_local;
    if (!is_current) {
        made.shape = shape;
        made.geometry = shape->revisions().geometry;
        made.view_from_local = view_from_local;
        make(made, indices_of(*shape, ordered ? back_to_front(*shape, view_from_local)
                                              : part_of(*shape, selection)));
    }
    return {made.buffer->name(), made.count};
}

void PrimitiveOrders::make(Made& made, const std::vector<std::uint32_t>& indices) const {
    static constexpr std::uint32_t nothing[4] = {};
    made.count = int(indices.size());
    made.buffer = indices.empty()
                      ? gl::Buffer{context_, sizeof nothing, nothing}
                      : gl::Buffer{context_, indices.size() * sizeof indices[0], indices.data()};
}

void PrimitiveOrders::collect() {
    std::erase_if(made_, [](const auto& entry) { return entry.second.shape.expired(); });
}

}  // namespace opacity::render
