#include "io/picture_maps.hpp"

#include <array>

#include "io/srgb.hpp"

namespace opacity {
namespace {

constexpr std::size_t levels = 65536;
constexpr float largest = levels - 1;

const std::vector<float>& linear_levels() {
    static const std::vector<float> table = [] {
        std::vector<float> linear(levels);
        for (std::size_t i = 0; i < levels; ++i) linear[i] = linear_from_srgb(float(i) / largest);
        return linear;
    }();
    return table;
}

}  // namespace

// `texel` adds the values of one from those that the picture stores.
template <class Texel>
TextureMapPtr PictureMaps::map(int channels, const Texel& texel) const {
    TextureMap map{picture_.width, picture_.height, channels, {}};
    const auto stride = std::size_t(picture_.channels);
    map.values.reserve(picture_.values.size() / stride * std::size_t(channels));
    for (std::size_t at = 0; at < picture_.values.size(); at += stride)
        texel(&picture_.values[at], map.values);
    return std::make_shared<const TextureMap>(std::move(map));
}

const TextureMapPtr& PictureMaps::color() {
    if (color_) return color_;
    const std::vector<float>& linear = linear_levels();
    const std::size_t step = picture_.channels < 3 ? 0 : 1;  // a grey is all three
    return color_ = map(3, [&](const std::uint16_t* stored, std::vector<float>& values) {
               for (std::size_t c = 0; c < 3; ++c) values.push_back(linear[stored[c * step]]);
           });
}

const TextureMapPtr& PictureMaps::alpha() {
    if (!picture_.has_alpha()) return luminance();
    if (alpha_) return alpha_;
    const auto last = std::size_t(picture_.channels - 1);
    return alpha_ = map(1, [&](const std::uint16_t* stored, std::vector<float>& values) {
               values.push_back(float(stored[last]) / largest);
           });
}

const TextureMapPtr& PictureMaps::luminance() {
    if (luminance_) return luminance_;
    // ITU-R BT.709, in whole numbers that add up, so that a grey stays exactly what it is.
    constexpr std::array<std::uint32_t, 3> weights{2126, 7152, 722};
    const std::size_t step = picture_.channels < 3 ? 0 : 1;
    return luminance_ = map(1, [&](const std::uint16_t* stored, std::vector<float>& values) {
               std::uint32_t sum = 0;
               for (std::size_t c = 0; c < 3; ++c) sum += weights[c] * stored[c * step];
               values.push_back(float(sum / 10000.0) / largest);
           });
}

bool PictureMaps::alpha_varies() const {
    if (!picture_.has_alpha()) return false;
    const auto stride = std::size_t(picture_.channels);
    for (std::size_t at = stride - 1; at < picture_.values.size(); at += stride)
        if (picture_.values[at] != picture_.values[stride - 1]) return true;
    return false;
}

}  // namespace opacity
