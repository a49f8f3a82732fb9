#include "techniques/histogram.hpp"

#include <algorithm>

namespace opacity::techniques {
namespace {

constexpr int block_size_px = 4;

// Texels that a search looks at: those of a map of this size, spread over the whole, and of those
// so many with casters, with the empty ones between them.
constexpr int sampled_size_px = 128;
constexpr std::size_t most_sampled = 4096;

// One image a layer.
struct ReadBack {
    std::vector<float> targets, moment_targets;
    const DrawnLayers& drawn;

    ReadBack(PassContext& context, const DrawnLayers& layers)
        : targets{context.read<float>(layers.map)}, drawn{layers} {
        if (layers.moments) moment_targets = context.read<float>(*layers.moments);
    }

    int layers() const { return drawn.layer_count(); }
    std::size_t texel_count() const {
        return std::size_t(drawn.map.desc().width) * drawn.map.desc().height;
    }
    float plane(std::size_t texel, int k) const {
        return drawn.unit() * targets[index_of(texel, k)];
    }
    float moment(std::size_t texel, int k) const { return moment_targets[index_of(texel, k)]; }

   private:
    std::size_t index_of(std::size_t texel, int k) const {
        const Slot slot = drawn.slot_of(k);
        return (slot.target * texel_count() + texel) * planes_per_target + slot.channel;
    }
};

std::vector<std::size_t> sampled_indices(const ReadBack& back) {
    const int width_px = back.drawn.map.desc().width, height_px = back.drawn.map.desc().height;
    std::vector<std::size_t> texels;
    std::size_t covered = 0;
    const auto is_sampled = [stride = block_stride(width_px)](int i) {
        return i / block_size_px % stride == 0;
    };
    for (int y = 0; y < height_px; ++y)
        for (int x = 0; x < width_px; ++x) {
            if (!is_sampled(x) || !is_sampled(y)) continue;
            texels.push_back(std::size_t(y) * width_px + x);
            covered += back.plane(texels.back(), back.layers()) > 0.f;
        }
    const std::size_t stride = std::max<std::size_t>(1, covered / most_sampled);
    std::vector<std::size_t> some;
    for (std::size_t i = 0; i < texels.size(); i += stride) some.push_back(texels[i]);
    return some;
}

}  // namespace

int fine_layer_count(int map_width_px) {
    return map_width_px <= 1024 ? 64 : map_width_px <= 2048 ? 32 : 16;
}

int block_stride(int map_width_px) {
    return std::max(1, map_width_px / sampled_size_px);
}

SampledTexels sampled_texels(PassContext& context, const DrawnLayers& drawn) {
    const ReadBack back{context, drawn};
    SampledTexels sampled{sampled_indices(back), drawn.planes.get(), {}, {}};
    for (const std::size_t texel : sampled.indices)
        for (int k = 1; k <= back.layers(); ++k) {
            sampled.values.push_back(back.plane(texel, k));
            if (drawn.moments) sampled.moments.push_back(back.moment(texel, k));
        }
    return sampled;
}

}  // namespace opacity::techniques
