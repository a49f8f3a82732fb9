// The part of a texel that a strand's ribbon covers, by the deposit rule (docs/accuracy.md). GLSL:
// lib/ribbon.glsl, in the same order of operations, since both must see the same fragments.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "opacity/core/math.hpp"

namespace opacity {

struct Coverage {
    float along;   // f: the part of the column that the segment spans
    float across;  // c: the part of the texel that the ribbon covers across the strand
    float place;   // where on the segment: 0 at its root, 1 at its tip
    float depth;
};

// One segment in light space, with x its major axis: the one along which it covers more texels.
struct MajorSegment {
    float x, y, dx, dy, root_z, tip_z;
    bool steep;            // x and y are exchanged
    float slope, stretch;  // dy / dx, and the length over one texel of x

    MajorSegment(const float3& root, const float3& tip)
        : x{root[0]},
          y{root[1]},
          dx{tip[0] - root[0]},
          dy{tip[1] - root[1]},
          root_z{root[2]},
          tip_z{tip[2]},
          steep{std::abs(dy) > std::abs(dx)} {
        if (steep) std::swap(x, y), std::swap(dx, dy);
        slope = dy / dx;
        stretch = std::sqrt(1.f + slope * slope);
    }
    float begin() const { return std::min(x, x + dx); }
    float end() const { return std::max(x, x + dx); }
    float depth(float place) const { return mix(root_z, tip_z, place); }
    // As GLSL defines it.
    static float mix(float a, float b, float t) { return a * (1.f - t) + b * t; }
};

// A ribbon in one column of its major axis, whose middle is at `column`. All is evaluated on the
// segment's line at that middle, so that cutting a segment in two changes nothing.
struct RibbonColumn {
    float along;  // f; nothing is covered where it is not above 0
    float place, half_width, y, depth;

    RibbonColumn(const MajorSegment& s, float root_width_texels, float tip_width_texels,
                 float column)
        : along{std::min(s.end(), column + 0.5f) - std::max(s.begin(), column - 0.5f)} {
        place = std::min(std::max((column - s.x) / s.dx, 0.f), 1.f);
        const float width = MajorSegment::mix(root_width_texels, tip_width_texels, place);
        half_width = 0.5f * width * s.stretch;
        y = s.y + s.slope * (column - s.x);
        depth = s.depth(place);
    }
    // With the texel that begins at `row`; negative where they do not meet.
    float overlap(float row) const {
        return std::min(y + half_width, row + 1.f) - std::max(y - half_width, row);
    }
    // c, of the texel whose middle is at `row`.
    float across(float row) const { return std::clamp(overlap(row - 0.5f), 0.f, 1.f); }
};

// What the ribbon covers of the texel whose middle is at (column, row) on the segment's axes.
inline std::optional<Coverage> ribbon_coverage(const MajorSegment& s, float root_width_texels,
                                               float tip_width_texels, float column, float row) {
    const RibbonColumn ribbon{s, root_width_texels, tip_width_texels, column};
    if (!(ribbon.along > 0.f)) return {};
    const float across = ribbon.across(row);
    if (!(across > 0.f)) return {};
    return Coverage{std::min(ribbon.along, 1.f), across, ribbon.place, ribbon.depth};
}

// The papers' deposit: a line one texel wide, whatever the strand's width, with one fragment in
// each column whose middle the segment passes.
inline std::optional<Coverage> line_coverage(const MajorSegment& s, float column, float row) {
    if (!(s.begin() <= column && column < s.end())) return {};
    const float place = (column - s.x) / s.dx;
    const float y = s.y + place * s.dy;
    if (std::floor(y) != std::floor(row)) return {};
    return Coverage{1.f, 1.f, place, s.depth(place)};
}

}  // namespace opacity
