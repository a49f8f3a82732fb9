#include "map/segment_fragments.hpp"

namespace opacity {
namespace {

float3 xyz(const float4& p) {
    return {p[0], p[1], p[2]};
}

float3 mixed(const float3& a, const float3& along, float place) {
    return plus(a, scaled(along, place));
}

float4 seen_end(const MapFace& face, const float3& q, const float3& along, float width) {
    const float3 place = face.place(q);
    return {place[0], place[1], place[2], face.ribbon_width(q, along, width)};
}

}  // namespace

std::optional<MapSegment> segment_through(const LightCaster& caster, std::size_t first,
                                          const MapFace& face) {
    const float4 &root = caster.points[first], &tip = caster.points[first + 1];
    const float root_opacity = caster.opacity_at(first), tip_opacity = caster.opacity_at(first + 1);
    const float3 root_q = xyz(root), along = minus(xyz(tip), root_q);
    const float a = face.seen(root_q)[2], b = face.seen(xyz(tip))[2];
    constexpr float least = 1.001f * least_forward;
    if (std::max(a, b) <= least) return {};
    const float begin = a < least ? (least - a) / (b - a) : 0.f;
    const float end = b < least ? (least - a) / (b - a) : 1.f;
    MapSegment seen{.face = &face};
    seen.root_q = mixed(root_q, along, begin);
    seen.tip_q = mixed(root_q, along, end);
    seen.root_forward = MajorSegment::mix(a, b, begin);
    seen.tip_forward = MajorSegment::mix(a, b, end);
    seen.root_opacity = MajorSegment::mix(root_opacity, tip_opacity, begin);
    seen.tip_opacity = MajorSegment::mix(root_opacity, tip_opacity, end);
    seen.root = seen_end(face, seen.root_q, along, MajorSegment::mix(root[3], tip[3], begin));
    seen.tip = seen_end(face, seen.tip_q, along, MajorSegment::mix(root[3], tip[3], end));
    return seen;
}

Rows segment_rows(const LightCaster& caster, std::size_t first, const MapFace* face,
                  const SplitPlace& split, int map_size_px) {
    const auto in_map = segment_in_map(caster, first, face, split);
    if (!in_map) return {0, 0};
    const float4 &root = in_map->root, &tip = in_map->tip;
    // Across its major axis half its width times sqrt(2) at most, at the middle of a column beside.
    const float reach = 0.75f * std::max(root[3], tip[3]) + 1.f;
    return rows_between(std::min(root[1], tip[1]) - reach, std::max(root[1], tip[1]) + reach,
                        map_size_px);
}

}  // namespace opacity
