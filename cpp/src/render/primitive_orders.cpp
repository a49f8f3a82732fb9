#include "render/primitive_orders.hpp"

#include <algorithm>

#include "opacity/scene/strands.hpp"
#include "render/drawing_order.hpp"
#include "render/primitive_indices.hpp"
#include "scene/primitive_chunks.hpp"
#include "scene/strand_ranks.hpp"

namespace opacity::render {
namespace {

constexpr int ordered_whole = -1;
constexpr int most_frames_unused = 256;

double3 middle(const Shape& shape, const Primitives& primitives, std::size_t primitive) {
    const std::size_t corners = primitives.corners();
    double3 sum{};
    for (std::size_t corner = 0; corner < corners; ++corner) {
        const double3 p = shape.points()[primitives.point(primitive, corner)];
        for (std::size_t axis = 0; axis < 3; ++axis) sum[axis] += p[axis] / double(corners);
    }
    return sum;
}

// By the distance of the eye to their middles; equally far ones by number.
void sort_back_to_front(const Shape& shape, const double4x4& view_from_local,
                        std::vector<std::uint32_t>& order) {
    const Primitives primitives{shape};
    std::vector<float> distance(primitives.count());
    for (const std::uint32_t i : order) {
        const double3 p = transform_point(view_from_local, middle(shape, primitives, i));
        distance[i] = float(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
    }
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
        return distance[a] != distance[b] ? distance[a] > distance[b] : a < b;
    });
}

// By number: whether a pass draws the primitive. Whole strands, which would show gaps otherwise.
std::vector<char> drawn_primitives(const Shape& shape, const Selection& selection, double detail) {
    const auto is_in_part = [&](std::size_t number) {
        return int(number % std::size_t(selection.parts)) == selection.part;
    };
    std::vector<char> drawn(Primitives{shape}.count());
    const auto* strands = dynamic_cast<const Strands*>(&shape);
    if (!strands) {
        for (std::size_t i = 0; i < drawn.size(); ++i) drawn[i] = is_in_part(i);
        return drawn;
    }
    const auto ranks = detail < 1.0 ? strands->ranks() : nullptr;
    const std::vector<std::size_t> numbers = strand_numbers(*strands);
    for (std::size_t i = 0; i < drawn.size(); ++i)
        drawn[i] = is_in_part(numbers[i]) && (!ranks || ranks->is_kept(numbers[i], detail));
    return drawn;
}

double4x4 product(const double4x4& a, const double4x4& b) {
    double4x4 result{};
    for (int row = 0; row < 4; ++row)
        for (int column = 0; column < 4; ++column)
            for (int k = 0; k < 4; ++k)
                result[4 * row + column] += a[4 * row + k] * b[4 * k + column];
    return result;
}

std::vector<std::size_t> stored_firsts(const PrimitiveChunks& chunks, std::size_t indices_each) {
    std::vector<std::size_t> firsts;
    for (std::size_t chunk = 0; chunk <= chunks.count(); ++chunk)
        firsts.push_back(chunks.first(chunk) * indices_each);
    return firsts;
}

std::vector<IndexRange> ranges_of(const std::vector<std::size_t>& firsts, const ChunkRanges& seen) {
    std::vector<IndexRange> ranges;
    for (const ChunkRange& range : seen)
        if (const std::size_t count = firsts[range.end] - firsts[range.begin]; count > 0)
            ranges.push_back({firsts[range.begin], count});
    return ranges;
}

}  // namespace

Indices PrimitiveOrders::indices(const Pass& pass, const ShapePtr& shape, const GpuShape& gpu) {
    const auto lock = shape->lock();
    const ChunkRanges* told = pass.draws_unseen ? nullptr : pass.view->seen(*shape);
    const unsigned stored = gpu.indices.object->name();
    if (gpu.extinction.object) {
        const bool is_hidden = told && told->empty();
        return {stored, 0, {{0, is_hidden ? 0 : std::size_t(gpu.index_count)}}};
    }
    const auto chunks = shape->chunks();
    ChunkRanges seen = told ? *told : ChunkRanges{{0, chunks->count()}};
    if (keeps_nearest(pass))
        seen = front_to_back(*chunks, seen, product(pass.view->from_world(), shape->transform()));
    const Selection& selection = pass.state.selection;
    const bool has_strands = dynamic_cast<const Strands*>(shape.get()) != nullptr;
    const double detail = has_strands && !pass.draws_unseen ? pass.view->strand_detail() : 1.0;
    if (selection == Selection{} && detail >= 1.0)
        return {stored, gpu.order.object->name(),
                ranges_of(stored_firsts(*chunks, Primitives{*shape}.indices_each()), seen)};
    if (!selection.back_to_front) {
        const Made& made = part(selection, detail, shape);
        return {made.buffer->name(), made.primitives->name(), ranges_of(made.chunk_firsts, seen)};
    }
    const Made& made = back_to_front(pass, shape, seen);
    return {made.buffer->name(), made.primitives->name(), {{0, made.chunk_firsts.back()}}};
}

const PrimitiveOrders::Made& PrimitiveOrders::back_to_front(const Pass& pass, const ShapePtr& shape,
                                                            const ChunkRanges& seen) {
    Made& made = made_[{shape.get(), ordered_whole, 1.0}];
    made.frames_unused = 0;
    const double4x4 view_from_local = product(pass.view->from_world(), shape->transform());
    const Revision geometry = shape->revisions().geometry;
    if (made.shape.lock() == shape && made.geometry == geometry &&
        made.view_from_local == view_from_local && made.seen == seen)
        return made;
    const auto chunks = shape->chunks();
    std::vector<std::uint32_t> order;
    for (const ChunkRange& range : seen)
        order.insert(order.end(),
                     chunks->order->begin() + std::ptrdiff_t(chunks->first(range.begin)),
                     chunks->order->begin() + std::ptrdiff_t(chunks->first(range.end)));
    sort_back_to_front(*shape, view_from_local, order);
    made = {shape, geometry, view_from_local, seen, {}, {}, {0, 0}, 0};
    fill(made, *shape, order);
    return made;
}

const PrimitiveOrders::Made& PrimitiveOrders::part(const Selection& selection, double detail,
                                                   const ShapePtr& shape) {
    Made& made = made_[{shape.get(), selection.part, detail}];
    made.frames_unused = 0;
    const auto chunks = shape->chunks();
    if (made.shape.lock() == shape && made.geometry == chunks->order_revision) return made;
    made = {shape, chunks->order_revision, {}, {}, {}, {}, {}, 0};
    const std::vector<char> drawn = drawn_primitives(*shape, selection, detail);
    const std::size_t each = Primitives{*shape}.indices_each();
    std::vector<std::uint32_t> primitives;
    for (std::size_t chunk = 0; chunk < chunks->count(); ++chunk) {
        made.chunk_firsts.push_back(primitives.size() * each);
        for (std::size_t i = chunks->first(chunk); i < chunks->first(chunk + 1); ++i)
            if (const std::uint32_t primitive = (*chunks->order)[i]; drawn[primitive])
                primitives.push_back(primitive);
    }
    made.chunk_firsts.push_back(0);
    fill(made, *shape, primitives);
    return made;
}

void PrimitiveOrders::fill(Made& made, const Shape& shape,
                           const std::vector<std::uint32_t>& primitives) const {
    const auto buffer_of = [this](const std::vector<std::uint32_t>& numbers) {
        static constexpr std::uint32_t nothing[4] = {};
        return numbers.empty()
                   ? gl::Buffer{context_, sizeof nothing, nothing}
                   : gl::Buffer{context_, numbers.size() * sizeof numbers[0], numbers.data()};
    };
    const std::vector<std::uint32_t> indices = indices_of(Primitives{shape}, primitives);
    made.chunk_firsts.back() = indices.size();
    made.buffer = buffer_of(indices);
    made.primitives = buffer_of(primitives);
}

void PrimitiveOrders::collect() {
    for (auto& [key, made] : made_) ++made.frames_unused;
    std::erase_if(made_, [](const auto& entry) {
        return entry.second.shape.expired() || entry.second.frames_unused > most_frames_unused;
    });
}

}  // namespace opacity::render
