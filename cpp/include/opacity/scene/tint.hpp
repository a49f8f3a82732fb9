// What stops red, green and blue light by parts of their own: coloured smoke, hair with pigment.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "opacity/core/math.hpp"
#include "opacity/core/shared.hpp"
#include "opacity/core/source.hpp"

namespace opacity {

inline constexpr std::array channel_names{"red", "green", "blue"};

// A value a colour, one for all points or voxels, or one each.
struct Tint {
    // A colour that has the values that it had before keeps its revision, and with it all that was
    // made of it.
    explicit Tint(const std::vector<float3>& rgb, const Tint* before = nullptr);

    // As light of one colour meets them.
    struct Channel {
        Shared<std::vector<float>> values;
        Revision revision = next_revision();
    };
    std::array<Channel, channel_names.size()> channels;

    std::vector<float3> rgb() const;
    // What stands for all three where one number is asked for.
    std::vector<float> mean() const;
};

// Null: all colours are stopped alike.
using TintPtr = std::shared_ptr<const Tint>;

}  // namespace opacity
