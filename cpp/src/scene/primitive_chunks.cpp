#include "scene/primitive_chunks.hpp"

#include <numeric>

#include "core/parallel.hpp"
#include "scene/primitives.hpp"
#include "scene/space_curve.hpp"

namespace opacity {
namespace {

constexpr std::size_t primitives_at_once = 1 << 14;

template <class Numbers>
double3 middle_of(const Numbers& xyz, const Primitives& primitives, std::size_t i) {
    const std::size_t corners = primitives.corners();
    double3 sum{};
    for (std::size_t corner = 0; corner < corners; ++corner)
        for (std::size_t axis = 0; axis < 3; ++axis)
            sum[axis] +=
                double(xyz[3 * std::size_t(primitives.point(i, corner)) + axis]) / double(corners);
    return sum;
}

std::vector<std::uint32_t> order_of(const Shape& shape, const Primitives& primitives) {
    std::vector<std::uint32_t> order(primitives.count());
    std::iota(order.begin(), order.end(), 0u);
    if (order.size() <= PrimitiveChunks::size) return order;
    const Box bounds = shape.points().bounds();
    std::vector<std::uint64_t> keys(order.size());  // place, then number: no two are equal
    shape.points().visit([&](const auto& xyz) {
        parallel_parts(keys.size(), primitives_at_once, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i)
                keys[i] = place_on_curve(middle_of(xyz, primitives, i), bounds) << 32 | i;
        });
    });
    std::sort(keys.begin(), keys.end());
    std::transform(keys.begin(), keys.end(), order.begin(),
                   [](std::uint64_t key) { return std::uint32_t(key); });
    return order;
}

std::vector<Box> boxes_of(const Shape& shape, const Primitives& primitives,
                          const std::vector<std::uint32_t>& order) {
    constexpr std::size_t size = PrimitiveChunks::size;
    std::vector<Box> boxes((order.size() + size - 1) / size);
    shape.points().visit([&](const auto& xyz) {
        parallel_for(boxes.size(), [&](std::size_t chunk) {
            Box box;
            const std::size_t end = std::min(order.size(), (chunk + 1) * size);
            for (std::size_t i = chunk * size; i < end; ++i)
                for (std::size_t corner = 0; corner < primitives.corners(); ++corner) {
                    const auto* p = &xyz[3 * std::size_t(primitives.point(order[i], corner))];
                    box.extend(double3{double(p[0]), double(p[1]), double(p[2])});
                }
            boxes[chunk] = box;
        });
    });
    return boxes;
}

}  // namespace

PrimitiveChunks chunks_of(const Shape& shape, const PrimitiveChunks* last) {
    const Primitives primitives{shape};
    PrimitiveChunks chunks;
    if (last && last->order->size() == primitives.count()) {
        chunks.order = last->order;
        chunks.order_revision = last->order_revision;
    } else {
        chunks.order =
            std::make_shared<const std::vector<std::uint32_t>>(order_of(shape, primitives));
        chunks.order_revision = next_revision();
    }
    chunks.boxes = boxes_of(shape, primitives, *chunks.order);
    chunks.geometry = shape.revisions().geometry;
    return chunks;
}

}  // namespace opacity
