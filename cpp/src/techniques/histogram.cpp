#include "techniques/histogram.hpp"

#include <algorithm>
#include <initializer_list>

#include "techniques/sampled_texels.hpp"

namespace opacity::techniques {
namespace {

// Texels that a search looks at: those of a map of this size, spread over the whole, and of those
// so many with casters, with the empty ones between them.
constexpr int sampled_size_px = 128;
constexpr std::size_t most_sampled = 4096;

// What sampled layers hold, by texel.
class ReadBack {
   public:
    ReadBack(PassContext& context, const SampledLayers& sampled)
        : drawn_{sampled.drawn},
          texel_count_{std::size_t(sampled.map.desc().width) * sampled.map.desc().height},
          index_of_{drawn_, texel_count_},
          planes_{context.read<float>(sampled.map)} {
        if (sampled.moments) moments_ = context.read<float>(*sampled.moments);
        if (!sampled.start) return;
        start_ = context.read<float>(*sampled.start);
        end_ = context.read<float>(*sampled.end);
    }

    bool has_moments() const { return !moments_.empty(); }
    bool has_span() const { return !start_.empty(); }
    float plane(std::size_t texel, int k) const {
        return drawn_.unit() * planes_[index_of_(texel, k)];
    }
    float moment(std::size_t texel, int k) const { return moments_[index_of_(texel, k)]; }
    float depth_range(std::size_t texel) const { return end_[texel] - start_[texel]; }
    std::vector<std::size_t> chosen() const;

   private:
    const DrawnLayers& drawn_;
    std::size_t texel_count_;
    PlaneIndex index_of_;
    std::vector<float> planes_, moments_, start_, end_;
};

std::vector<std::size_t> ReadBack::chosen() const {
    std::size_t covered = 0;
    for (std::size_t texel = 0; texel < texel_count_; ++texel)
        covered += plane(texel, drawn_.layer_count()) > 0.f;
    const std::size_t stride = std::max<std::size_t>(1, covered / most_sampled);
    std::vector<std::size_t> some;
    for (std::size_t texel = 0; texel < texel_count_; texel += stride) some.push_back(texel);
    return some;
}

}  // namespace

int fine_layer_count(int map_width_px) {
    return map_width_px <= 1024 ? 64 : map_width_px <= 2048 ? 32 : 16;
}

BlockSample searched_blocks(int map_width_px) {
    return {std::max(1, map_width_px / sampled_size_px)};
}

void SampledLayers::add_to(Reads& reads) const {
    for (const Source* source : std::initializer_list<const Source*>{&map, moments, start, end})
        if (source) reads.push_back(source);
}

SampledLayers add_sampled_layers(FrameGraph& graph, const ShadowInputs& inputs,
                                 const DrawnLayers& drawn) {
    const BlockSample all = searched_blocks(inputs.space.width_px());
    const auto sampled = [&](Texture* map, const BlockSample& blocks) {
        return map ? &add_sampled_texels(graph, inputs, *map, blocks) : nullptr;
    };
    const BlockSample left = drawn.kept.stride == 1 ? all : BlockSample{};
    const bool has_span = drawn.span.start && drawn.span.end;
    return {drawn, *sampled(&drawn.map, left), sampled(drawn.moments, left),
            sampled(has_span ? drawn.span.start : nullptr, all),
            sampled(has_span ? drawn.span.end : nullptr, all)};
}

SampledTexels read_texels(PassContext& context, const SampledLayers& sampled) {
    const ReadBack back{context, sampled};
    SampledTexels some{sampled.drawn.planes.get(), {}, {}, {}};
    for (const std::size_t texel : back.chosen()) {
        for (int k = 1; k <= sampled.drawn.layer_count(); ++k) {
            some.values.push_back(back.plane(texel, k));
            if (back.has_moments()) some.moments.push_back(back.moment(texel, k));
        }
        if (back.has_span()) some.depth_ranges.push_back(back.depth_range(texel));
    }
    return some;
}

}  // namespace opacity::techniques
