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
std::optional<MapSegment> segment_in_map(const LightCaster& caster, std::size_t first,
                                         const MapFace* face, const SplitPlace& split);

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
    const Rows columns = s.steep ? rows : all, across = s.steep ? all : rows;
    const auto within = [](float v, Rows range) {
        return std::clamp(v, float(range.begin), float(range.end));
    };
    const int begin = floor_of(within(s.begin(), columns));
    const int end = ceil_of(within(s.end(), columns));
    const auto emit = [&](int column, int row, float depth, float picture_place, float f, float c) {
        const float place = in_map->place(picture_place);
        depth = in_map->depth(place, depth);
        const auto optical_depth = [&] { return f * optical_depth_of(in_map->opacity(place) * c); };
        s.steep ? sink(row, column, depth, depth, optical_depth)
                : sink(column, row, depth, depth, optical_depth);
    };
    for (int column = begin; column < end; ++column) {
        const float middle = float(column) + 0.5f;
        const RibbonColumn ribbon{s, root[3], tip[3], middle};
        const float reach = source.paper_deposit ? 1.f : ribbon.half_width;
        const int low = floor_of(within(ribbon.y - reach, across));
        const int high = ceil_of(within(ribbon.y + reach, across));
        for (int row = low; row < high; ++row) {
            if (source.paper_deposit) {
                if (const auto line = line_coverage(s, middle, float(row) + 0.5f))
                    emit(column, row, line->depth, line->place, 1.f, 1.f);
                continue;
            }
            const float c = ribbon.across(float(row) + 0.5f);
            if (ribbon.along > 0.f && c > 0.f)
                emit(column, row, ribbon.depth, ribbon.place, std::min(ribbon.along, 1.f), c);
        }
    }
}

}  // namespace opacity
