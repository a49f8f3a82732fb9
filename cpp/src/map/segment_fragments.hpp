// The fragments of strands: the texels that the ribbon of a segment covers. GLSL:
// casters/strands.vert.glsl and casters/strands.frag.glsl.
#pragma once

#include <optional>

#include "core/opacity.hpp"
#include "map/fragment_source.hpp"
#include "map/ribbon.hpp"

namespace opacity {

// std::floor and std::ceil are calls where the target has no instruction for them. |v| < 2^31.
inline int floor_of(float v) {
    const int truncated = int(v);
    return truncated - (float(truncated) > v);
}
inline int ceil_of(float v) {
    return -floor_of(-v);
}

// A segment as the map sees it. Through a face, what is even along the segment is not along its
// picture.
struct MapSegment {
    float4 root{}, tip{};  // places in the map; w: width in texels
    float root_opacity = 0.f, tip_opacity = 0.f;
    // Of a face, else null: light coordinates of both ends, and how far before the face they are.
    const MapFace* face = nullptr;
    float3 root_q{}, tip_q{};
    float root_forward = 0.f, tip_forward = 0.f;

    float opacity(float place) const { return MajorSegment::mix(root_opacity, tip_opacity, place); }
    // Where on the segment, by where on its picture.
    float place(float s) const {
        if (!face) return s;
        return s * root_forward / ((1.f - s) * tip_forward + s * root_forward);
    }
    float depth(float place, float picture_depth) const {
        if (!face) return picture_depth;
        float3 q;
        for (std::size_t i = 0; i < 3; ++i) q[i] = MajorSegment::mix(root_q[i], tip_q[i], place);
        return face->depth(q);
    }
};
// Nothing where it is not before the face.
std::optional<MapSegment> segment_through(const LightCaster& caster, std::size_t first,
                                          const MapFace& face);
inline std::optional<MapSegment> segment_in_map(const LightCaster& caster, std::size_t first,
                                                const MapFace* face, const SplitPlace& split) {
    if (face) return segment_through(caster, first, *face);
    return MapSegment{split.place(caster.points[first]), split.place(caster.points[first + 1]),
                      caster.opacity_at(first), caster.opacity_at(first + 1)};
}
// Those that it may leave fragments in, or more.
Rows segment_rows(const LightCaster& caster, std::size_t first, const MapFace* face,
                  const SplitPlace& split, int map_size_px);

// Between which whole numbers something lies, as far as it is within others.
inline Rows whole_between(float low, float high, Rows range) {
    const auto within = [&](float v) {
        return std::min(std::max(v, float(range.begin)), float(range.end));
    };
    return {floor_of(within(low)), ceil_of(within(high))};
}

// Hands on what a segment leaves in texels by their place on its axes.
template <bool steep, class Sink>
struct SegmentSink {
    const MapSegment& segment;
    Sink& sink;

    bool wants_column(int column) const {
        return steep ? sink.wants_row(column) : sink.wants_column(column);
    }
    // Inlined: it runs for every fragment.
    [[gnu::always_inline]] void operator()(int column, int row, float depth, float picture_place,
                                           float f, float c) const {
        const float place = segment.face ? segment.place(picture_place) : picture_place;
        if (segment.face) depth = segment.depth(place, depth);
        const auto optical_depth = [&] { return f * optical_depth_of(segment.opacity(place) * c); };
        if constexpr (steep)
            sink(row, column, depth, depth, optical_depth);
        else
            sink(column, row, depth, depth, optical_depth);
    }
};

// The columns in which the segment comes so near to the rows.
inline Rows columns_near(const MajorSegment& s, float reach, Rows columns, Rows rows) {
    float begin = s.begin(), end = s.end();
    if (s.slope != 0.f) {
        const float a = s.x + (float(rows.begin) - reach - s.y) / s.slope;
        const float b = s.x + (float(rows.end) + reach - s.y) / s.slope;
        begin = std::max(begin, std::min(a, b)), end = std::min(end, std::max(a, b));
    }
    return whole_between(begin, end, columns);
}

// Texels of its ribbon, within columns and rows of the segment's axes.
template <class Emit>
void ribbon_fragments(const MajorSegment& s, float root_width, float tip_width, Rows columns,
                      Rows rows, const Emit& emit) {
    // At the middle of a column that may lie beside it.
    const float reach = 0.5f * std::max(root_width, tip_width) * s.stretch + 2.f;
    columns = columns_near(s, reach, columns, rows);
    for (int column = columns.begin; column < columns.end; ++column) {
        if (!emit.wants_column(column)) continue;
        const RibbonColumn ribbon{s, root_width, tip_width, float(column) + 0.5f};
        const float low = std::max(ribbon.y - ribbon.half_width, float(rows.begin));
        const float high = std::min(ribbon.y + ribbon.half_width, float(rows.end));
        if (!(ribbon.along > 0.f && low < high)) continue;
        float side = float(int(low));  // of a texel
        for (int row = int(low); side < high; ++row, side += 1.f) {
            const float c = ribbon.overlap(side);
            if (c > 0.f)
                emit(column, row, ribbon.depth, ribbon.place, std::min(ribbon.along, 1.f), c);
        }
    }
}

// The same of the papers' line.
template <class Emit>
void line_fragments(const MajorSegment& s, Rows columns, Rows rows, const Emit& emit) {
    columns = columns_near(s, 2.f, columns, rows);
    for (int column = columns.begin; column < columns.end; ++column) {
        const float middle = float(column) + 0.5f, y = s.y + s.slope * (middle - s.x);
        const Rows near = whole_between(y - 1.f, y + 1.f, rows);
        for (int row = near.begin; row < near.end; ++row)
            if (const auto line = line_coverage(s, middle, float(row) + 0.5f))
                emit(column, row, line->depth, line->place, 1.f, 1.f);
    }
}

// One segment's fragments within the rows. `Sink` takes x, y, where the fragment begins and ends in
// depth, and what gives the optical depth.
template <class Sink>
void segment_fragments(const LightCaster& caster, std::size_t first, const FragmentSource& source,
                       const MapFace* face, Rows rows, Sink&& sink) {
    const auto in_map = segment_in_map(caster, first, face, source.split);
    if (!in_map) return;
    const float4 &root = in_map->root, &tip = in_map->tip;
    const MajorSegment s{{root[0], root[1], root[2]}, {tip[0], tip[1], tip[2]}};
    if (s.dx == 0.f) return;  // along the light: no area, no texel
    const Rows all{0, source.space.map_size_px};
    const auto fill = [&](Rows columns, Rows across, const auto& emit) {
        if (source.paper_deposit)
            line_fragments(s, columns, across, emit);
        else
            ribbon_fragments(s, root[3], tip[3], columns, across, emit);
    };
    using Taken = std::remove_reference_t<Sink>;
    if (s.steep)
        fill(rows, all, SegmentSink<true, Taken>{*in_map, sink});
    else
        fill(all, rows, SegmentSink<false, Taken>{*in_map, sink});
}

}  // namespace opacity
