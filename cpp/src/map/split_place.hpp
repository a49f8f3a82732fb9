// A split of a directional light in float32, as lib/light.glsl has it, in the same order of
// operations.
#pragma once

#include "core/vector.hpp"
#include "opacity/scene/light_space.hpp"

namespace opacity {

// From light coordinates; as it stands, the whole map, where everything stays as it is.
struct SplitPlace {
    float scale = 1.f;
    float offset_px[2] = {0.f, 0.f};

    SplitPlace() = default;
    explicit SplitPlace(const LightSplit& split)
        : scale{float(split.scale)},
          offset_px{float(split.offset_px[0]), float(split.offset_px[1])} {}

    float3 place(const float3& q) const {
        return {scale * q[0] + offset_px[0], scale * q[1] + offset_px[1], q[2]};
    }
    // w: a width.
    float4 place(const float4& q) const {
        return {scale * q[0] + offset_px[0], scale * q[1] + offset_px[1], q[2], scale * q[3]};
    }
    // Of a place in the split.
    float2 turned_back(const float2& p) const {
        return {(p[0] - offset_px[0]) / scale, (p[1] - offset_px[1]) / scale};
    }
};

// Of the whole map where there is no split.
inline SplitPlace split_place(const LightSpace& space, int split) {
    return space.splits.empty() ? SplitPlace{} : SplitPlace{space.splits[std::size_t(split)]};
}

// The same maps, with the texels of one split.
inline LightSpace with_texels_of(LightSpace space, int split) {
    if (!space.splits.empty()) space.texels_per_unit *= space.splits[std::size_t(split)].scale;
    return space;
}

}  // namespace opacity
