#include "render/shadow_sweep.hpp"

#include <algorithm>
#include <cmath>

#include "core/vector.hpp"
#include "opacity/scene/mesh.hpp"

namespace opacity::render {
namespace {

// A shader may round otherwise than we do here.
constexpr float margin = 1e-5f;

struct SlabRange {
    std::size_t first, last;
};

SlabRange range_of(const DepthRange& depths, std::span<const float> planes) {
    const std::size_t slabs = planes.size() - 1;
    if (!(depths.first <= depths.last)) return {0, 0};  // not a number
    const auto slab_at = [&](float depth) {
        const auto above = std::upper_bound(planes.begin() + 1, planes.end() - 1, depth);
        return std::min(std::size_t(above - planes.begin()) - 1, slabs - 1);
    };
    return {slab_at(depths.first - margin), slab_at(depths.last + margin)};
}

// How far a rasteriser, which moves corners, may set surfaces off that the light grazes.
constexpr double margin_texels = 8.0;

// From the eye of a face to the nearest and the farthest place in a box of light coordinates.
DepthRange depths_through(const LightFace& face, const Box& box) {
    const double3 back = face.turned_back(face.offset);
    const double3 eye{-back[0], -back[1], -back[2]};
    double3 nearest, farthest;
    for (std::size_t i = 0; i < 3; ++i) {
        nearest[i] = std::clamp(eye[i], box.min[i], box.max[i]);
        farthest[i] = eye[i] < 0.5 * (box.min[i] + box.max[i]) ? box.max[i] : box.min[i];
    }
    const double start = face.depth_of_origin - std::hypot(back[0], back[1], back[2]);
    return {float(start + distance(nearest, eye)), float(start + distance(farthest, eye))};
}

}  // namespace

DepthRange depths_of(const Shape& shape, const LightSpace& space) {
    const auto lock = shape.lock();
    const Box box = shape.bounds().transformed(space.from_world);
    DepthRange range{float(box.min[2]), float(box.max[2])};
    for (std::size_t i = 0; i < space.faces.size(); ++i) {
        const DepthRange seen = depths_through(space.faces[i], box);
        range =
            i == 0 ? seen
                   : DepthRange{std::min(range.first, seen.first), std::max(range.last, seen.last)};
    }
    float reach = margin;
    if (dynamic_cast<const Mesh*>(&shape))
        reach += float(margin_texels / (space.texels_per_unit * space.depth_range));
    return {range.first - reach, range.last + reach};
}

ShapeFilter near_plane(std::span<const float> planes, int k, const LightSpace& space) {
    return [planes, k, &space](const Shape& shape) {
        const DepthRange depths = depths_of(shape, space);
        const bool is_stored =
            k > Sweep::planes_held && depths.last < planes[k - Sweep::planes_held];
        return !is_stored && !(depths.first > planes[k]);
    };
}

DepthSlab slab_of(std::span<const float> planes, std::size_t i) {
    return {planes[i], planes[i + 1], i == 0, i + 2 == planes.size()};
}

// By counting: the work grows with the receivers, whatever the number of slabs.
SlabLists sorted_into_slabs(std::span<const Receiver> receivers, float width,
                            const MapLookUp& look_up, std::span<const float> planes) {
    std::vector<SlabRange> ranges;
    SlabLists lists{{}, std::vector<std::size_t>(planes.size(), 0)};
    for (const Receiver& receiver : receivers) {
        ranges.push_back(range_of(look_up.depths(receiver, width), planes));
        for (std::size_t i = ranges.back().first; i <= ranges.back().last; ++i)
            ++lists.firsts[i + 1];
    }
    for (std::size_t i = 1; i < lists.firsts.size(); ++i) lists.firsts[i] += lists.firsts[i - 1];
    lists.receivers.resize(lists.firsts.back());
    std::vector<std::size_t> next = lists.firsts;
    for (std::size_t r = 0; r < ranges.size(); ++r)
        for (std::size_t i = ranges[r].first; i <= ranges[r].last; ++i)
            lists.receivers[next[i]++] = std::uint32_t(r);
    return lists;
}

}  // namespace opacity::render
