#include "opacity/scene/tint.hpp"

namespace opacity {

Tint::Tint(const std::vector<float3>& rgb, const Tint* before) {
    for (std::size_t c = 0; c < channels.size(); ++c) {
        std::vector<float> values;
        values.reserve(rgb.size());
        for (const float3& value : rgb) values.push_back(value[c]);
        if (before && *before->channels[c].values == values)
            channels[c] = before->channels[c];
        else
            channels[c].values = std::move(values);
    }
}

std::vector<float3> Tint::rgb() const {
    const auto& [red, green, blue] = channels;
    std::vector<float3> rgb;
    rgb.reserve(red.values->size());
    for (std::size_t i = 0; i < red.values->size(); ++i)
        rgb.push_back({(*red.values)[i], (*green.values)[i], (*blue.values)[i]});
    return rgb;
}

std::vector<float> Tint::mean() const {
    std::vector<float> mean;
    for (const float3& value : rgb())
        mean.push_back(float((double(value[0]) + value[1] + value[2]) / 3.0));
    return mean;
}

}  // namespace opacity
