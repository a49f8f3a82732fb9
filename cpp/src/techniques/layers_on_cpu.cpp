#include "techniques/layers_on_cpu.hpp"

#include <algorithm>

#include "map/fragments.hpp"
#include "map/planes.hpp"

namespace opacity::techniques {
namespace {

// `pick` takes the depth so far, and the fragment.
template <class Pick>
OnCpu depth_on_cpu(const ShadowInputs& inputs, Texture& depth, Pick pick) {
    return [inputs, &depth, pick](PassContext& context) {
        const std::span<float> map = context.memory<float>(depth);
        for_each_fragment(inputs.fragments(context, false), [&](const Fragment& fragment) {
            map[fragment.texel] = pick(map[fragment.texel], fragment);
        });
    };
}

// Where the map holds plane k in 1 .. K of a texel.
std::size_t place_of(std::size_t texel_count, std::size_t texel, int k) {
    const int target = (k - 1) / planes_per_target, channel = (k - 1) % planes_per_target;
    return (target * texel_count + texel) * planes_per_target + channel;
}

struct Planes {
    std::span<const float> start, end, planes;
    int last_plane() const { return int(planes.size()) - 1; }
    float position(std::size_t texel, float depth) const {
        return between(start[texel], end[texel], depth);
    }
};

// First each layer's own optical depth, then the sum of all before: one write a fragment.
class Layers {
   public:
    Layers(const Planes& planes, std::span<float> map, int first_plane, int last_plane)
        : planes_{planes}, map_{map}, first_plane_{first_plane}, last_plane_{last_plane} {}

    void add(const Fragment& fragment) {
        const float begin = planes_.position(fragment.texel, fragment.depth);
        const float end = planes_.position(fragment.texel, fragment.depth_end);
        int k = std::max(layer_of(planes_.planes, begin) + 1, first_plane_);
        for (float so_far = 0.f; k <= last_plane_ && so_far < 1.f; ++k) {
            const float part = end > begin ? counted_at(planes_.planes, k, begin, end) : 1.f;
            plane(fragment.texel, k) += fragment.optical_depth * (part - so_far);
            so_far = part;
        }
    }
    void accumulate(std::size_t texel) {
        double sum = 0.0;
        for (int k = first_plane_; k <= last_plane_; ++k) {
            sum += double(plane(texel, k));
            plane(texel, k) = float(sum);
        }
    }

   private:
    float& plane(std::size_t texel, int k) {
        return map_[place_of(planes_.start.size(), texel, k)];
    }
    Planes planes_;
    std::span<float> map_;
    int first_plane_, last_plane_;
};

class LayeredTexels : public TexelMap {
   public:
    LayeredTexels(const Planes& planes, std::span<const float> map) : planes_{planes}, map_{map} {}

    float optical_depth(std::size_t texel, float depth, const OwnDeposit& own) const override {
        const float start = planes_.start[texel], end = planes_.end[texel];
        if (!(depth > start)) return 0.f;
        if (depth >= end) return plane(texel, planes_.last_plane()) - own.optical_depth;
        const float x = between(start, end, depth);
        const int layer = layer_of(planes_.planes, x);
        const float low = planes_.planes[layer], high = planes_.planes[layer + 1];
        const float along = (x - low) / (high - low);
        const float part = counted(planes_.planes, planes_.position(texel, own.depth),
                                   planes_.position(texel, own.depth_end), layer, along);
        const float before = plane(texel, layer), behind = plane(texel, layer + 1);
        return before * (1.f - along) + behind * along - own.optical_depth * part;
    }

   private:
    // Nothing is in front of plane 0.
    float plane(std::size_t texel, int k) const {
        return k == 0 ? 0.f : map_[place_of(planes_.start.size(), texel, k)];
    }
    Planes planes_;
    std::span<const float> map_;
};

Planes planes_in(PassContext& context, const DrawnLayers& layers) {
    return {context.memory<float>(*layers.span.start), context.memory<float>(*layers.span.end),
            layers.planes.get()};
}

}  // namespace

OnCpu first_depth_on_cpu(const ShadowInputs& inputs, Texture& depth) {
    return depth_on_cpu(inputs, depth,
                        [](float first, const Fragment& f) { return std::min(first, f.depth); });
}

OnCpu last_depth_on_cpu(const ShadowInputs& inputs, Texture& depth) {
    return depth_on_cpu(inputs, depth,
                        [](float last, const Fragment& f) { return std::max(last, f.depth_end); });
}

OnCpu layers_on_cpu(const ShadowInputs& inputs, const DrawnLayers& drawn, int first_target,
                    int target_count, int block_stride) {
    return [=](PassContext& context) {
        const Planes planes = planes_in(context, drawn);
        const int first_plane = planes_per_target * first_target + 1;
        const int last_plane =
            std::min(planes_per_target * (first_target + target_count), planes.last_plane());
        Layers layers{planes, context.memory<float>(drawn.map), first_plane, last_plane};
        const auto is_sampled = [block_stride](int i) { return i / 4 % block_stride == 0; };
        for_each_fragment(inputs.fragments(context, true), [&](const Fragment& fragment) {
            if (is_sampled(fragment.x) && is_sampled(fragment.y)) layers.add(fragment);
        });
        const std::size_t row_texels = std::size_t(drawn.map.desc().width);
        parallel_for(std::size_t(drawn.map.desc().height), [&](std::size_t row) {
            for (std::size_t i = 0; i < row_texels; ++i) layers.accumulate(row * row_texels + i);
        });
    };
}

std::function<std::unique_ptr<TexelMap>(PassContext&)> look_up_on_cpu(const DrawnLayers& layers) {
    return [layers](PassContext& context) {
        return std::make_unique<LayeredTexels>(planes_in(context, layers),
                                               context.memory<float>(layers.map));
    };
}

}  // namespace opacity::techniques
