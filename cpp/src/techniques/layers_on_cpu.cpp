#include "techniques/layers_on_cpu.hpp"

#include <algorithm>

#include "core/opacity.hpp"
#include "core/parallel.hpp"
#include "map/depth_bits.hpp"
#include "map/fragments.hpp"
#include "map/layer_held.hpp"
#include "map/monotone_cubic.hpp"
#include "techniques/texel_spans.hpp"

namespace opacity::techniques {
namespace {

// Those of each tile of texels, one tile after the other.
std::vector<float> tile_planes(std::span<const float> places, std::size_t tiles, int last_plane) {
    const std::size_t count = std::size_t(last_plane) + 1;
    std::vector<float> planes(tiles * count);
    parallel_parts(tiles, 1024, [&](std::size_t first_tile, std::size_t last_tile) {
        for (std::size_t tile = first_tile; tile < last_tile; ++tile) {
            float* const own = planes.data() + tile * count;
            for (int k = 1; k < last_plane; ++k)
                own[k] = places[index_of(slot_of(k, false), tile, tiles)];
            own[last_plane] = 1.f;
        }
    });
    return planes;
}

// Where a texel lays its planes.
class LayerPlanes : public TexelSpans {
   public:
    LayerPlanes(PassContext& context, const DrawnLayers& drawn)
        : TexelSpans{context, drawn.span},
          planes_{drawn.planes.get()},
          last_plane_{drawn.layer_count()},
          width_px_{std::size_t(drawn.map.desc().width)},
          region_px_{std::size_t(drawn.curves.region_px)},
          ignores_beyond_{drawn.ignores_beyond} {
        if (drawn.tiles.places) use(context, drawn.tiles);
        if (!drawn.curves.ratios) return;
        ratios_ = context.memory<float>(*drawn.curves.ratios);
        regions_across_ = std::size_t(drawn.curves.ratios->desc().width);
    }

    // On [0, 1].
    std::span<const float> of(std::size_t texel) const {
        return planes_.subspan(curve_of(texel) * std::size_t(last_plane_ + 1),
                               std::size_t(last_plane_ + 1));
    }
    int last_plane() const { return last_plane_; }
    // Where nothing casts, the pass that lays them may not have run, or not for so many layers.
    bool are_laid() const { return planes_.size() > std::size_t(last_plane_); }
    float counted_part(std::size_t texel, float begin, float end_depth) const {
        if (!ignores_beyond_) return 1.f;
        if (!(end_depth > begin)) return begin > end(texel) ? 0.f : 1.f;
        return part_in_front(begin, end_depth, end(texel));
    }

   private:
    void use(PassContext& context, const TilePlanes& tiles) {
        const TextureDesc& desc = tiles.places->desc();
        region_px_ = std::size_t(tiles.tile_px);
        regions_across_ = std::size_t(desc.width);
        tile_planes_ = tile_planes(context.memory<float>(*tiles.places),
                                   regions_across_ * std::size_t(desc.height), last_plane_);
        planes_ = tile_planes_;
    }
    std::size_t curve_of(std::size_t texel) const {
        if (regions_across_ == 0) return 0;
        const std::size_t x = texel % width_px_ / region_px_, y = texel / width_px_ / region_px_;
        const std::size_t region = y * regions_across_ + x;
        if (ratios_.empty()) return region;
        return std::size_t(float(split_trials - 1) * ratios_[region] + 0.5f);
    }

    std::span<const float> planes_;
    int last_plane_;
    std::size_t width_px_, region_px_, regions_across_ = 0;
    std::vector<float> tile_planes_;
    std::span<const float> ratios_;
    bool ignores_beyond_;
};

// What a map's channels hold: lib/layer_map.glsl.
class LayerMap {
   public:
    LayerMap(PassContext& context, const DrawnLayers& drawn, bool planes, bool moments)
        : format_{drawn.map.desc().format},
          unit_{drawn.unit()},
          drawn_{drawn},
          index_of_{drawn, std::size_t(drawn.map.desc().width) * drawn.map.desc().height} {
        if (planes) values_ = context.memory<float>(drawn.map);
        if (moments) moments_ = context.memory<float>(*drawn.moments);
    }
    LayerMap(PassContext& context, const DrawnLayers& drawn)
        : LayerMap{context, drawn, true, drawn.moments != nullptr} {}

    // Texels by where they are in an image (DrawnLayers::place_of).
    float& plane(std::size_t texel, int k) const { return values_[index_of_(texel, k)]; }
    // In a packed map.
    float& start(std::size_t texel) const { return values_[texel * planes_per_target + 3]; }
    // The first plane that is not in the image of plane k.
    int end_of_image(int k) const {
        return k + planes_per_target - int(drawn_.slot_of(k).channel) -
               int(drawn_.is_packed && k < planes_per_target);
    }
    bool has_planes() const { return !values_.empty(); }
    bool has_moments() const { return !moments_.empty(); }
    // Of optical depth times position in front of plane k > 0.
    float& moment(std::size_t texel, int k) const { return moments_[index_of_(texel, k)]; }
    // Nothing is in front of plane 0.
    float optical_depth(std::size_t texel, int k) const {
        if (k == 0) return 0.f;
        return drawn_.kappa ? unit_ * std::min(plane(texel, k), 1.f) : plane(texel, k);
    }
    // What `part` of a caster adds to a plane, beyond what `less` of it does.
    float added(float optical_depth, float part, float less) const {
        if (!drawn_.kappa) return optical_depth * (part - less);
        const auto stored = [&](float value) {
            return rounded_to_8_bits(std::min(optical_depth * value / unit_, 1.f));
        };
        return stored(part) - stored(less);
    }
    // What is left of a sum.
    float kept(float sum) const {
        if (drawn_.kappa) return rounded_to_8_bits(std::min(sum, 1.f));
        return format_ == Format::rgba16f ? rounded_to_half(sum) : sum;
    }

   private:
    std::span<float> values_, moments_;
    Format format_;
    float unit_;
    const DrawnLayers& drawn_;
    PlaneIndex index_of_;
};

// First each layer's own optical depth, then the sum of all before: one write a fragment. Sums go
// on from what the map has kept of the image before, so that they do not depend on how many images
// a pass writes.
class LayerSums {
   public:
    LayerSums(const DrawnLayers& drawn, const LayerPlanes& planes, const LayerMap& map,
              int first_plane, int last_plane)
        : drawn_{drawn},
          planes_{planes},
          map_{map},
          first_plane_{first_plane},
          last_plane_{last_plane} {}

    void add(const Fragment& fragment) {
        const std::size_t texel = fragment.texel, place = drawn_.place_of(fragment.x, fragment.y);
        const float optical_depth = fragment.optical_depth *
                                    planes_.counted_part(texel, fragment.depth, fragment.depth_end);
        const std::span<const float> planes = planes_.of(texel);
        const float begin = planes_.position(texel, fragment.depth);
        const int next = layer_of(planes, begin) + 1;
        const float end = fragment.depth_end > fragment.depth
                              ? planes_.position(texel, fragment.depth_end)
                              : begin;
        if (end > begin)
            add_interval(place, planes, begin, end, next, optical_depth);
        else if (next >= first_plane_ && next <= last_plane_)
            add_point(place, begin, next, optical_depth);
    }
    // In these texels of an image.
    void accumulate(std::size_t first_texel, std::size_t last_texel) {
        for (int k = first_plane_; k <= last_plane_; k = map_.end_of_image(k)) {
            const int end = std::min(map_.end_of_image(k), last_plane_ + 1);
            for (std::size_t texel = first_texel; texel < last_texel; ++texel) {
                if (map_.has_planes())
                    sum_up(
                        k, end, [&](int plane) -> float& { return map_.plane(texel, plane); },
                        [&](float sum) { return map_.kept(sum); });
                if (map_.has_moments())
                    sum_up(
                        k, end, [&](int plane) -> float& { return map_.moment(texel, plane); },
                        [](float sum) { return sum; });
            }
        }
    }

   private:
    void add_point(std::size_t place, float position, int plane, float optical_depth) {
        if (map_.has_planes()) map_.plane(place, plane) += map_.added(optical_depth, 1.f, 0.f);
        if (map_.has_moments()) map_.moment(place, plane) += optical_depth * position;
    }
    void add_interval(std::size_t place, std::span<const float> planes, float begin, float end,
                      int next, float optical_depth) {
        int k = std::max(next, first_plane_);
        float so_far = k > 1 ? part_in_front(begin, end, planes[std::size_t(k) - 1]) : 0.f;
        float moment = so_far * mean_in_front(planes, k - 1, begin, end);
        for (; k <= last_plane_ && so_far < 1.f; ++k) {
            const float part = part_in_front(begin, end, planes[std::size_t(k)]);
            if (map_.has_planes()) map_.plane(place, k) += map_.added(optical_depth, part, so_far);
            so_far = part;
            if (!map_.has_moments()) continue;
            const float here = part * mean_in_front(planes, k, begin, end);
            map_.moment(place, k) += optical_depth * (here - moment);
            moment = here;
        }
    }
    // Planes k to end of one image.
    template <class At, class Kept>
    static void sum_up(int k, int end, At at, Kept kept) {
        double sum = k > 1 ? double(at(k - 1)) : 0.0;
        for (; k < end; ++k) {
            sum += double(at(k));
            at(k) = kept(float(sum));
        }
    }

    const DrawnLayers& drawn_;
    const LayerPlanes& planes_;
    const LayerMap& map_;
    int first_plane_, last_plane_;
};

class LayeredTexels : public TexelMap {
   public:
    LayeredTexels(PassContext& context, const DrawnLayers& drawn, Interpolation interpolation)
        : drawn_{drawn},
          planes_{context, drawn_},
          map_{context, drawn_},
          interpolation_{interpolation} {}

    float optical_depth(std::size_t texel, float depth, const OwnDeposit& own) const override {
        if (!(depth > planes_.start(texel)) || !planes_.are_laid()) return 0.f;
        const float counted = planes_.counted_part(texel, own.depth, own.depth_end);
        const OwnDeposit placed{planes_.position(texel, own.depth),
                                planes_.position(texel, own.depth_end),
                                counted * own.optical_depth};
        const float x = planes_.position(texel, depth);
        const int layer = layer_of(planes_.of(texel), x);
        const float in_front =
            std::min(counted * own_in_front(own, depth), map_.optical_depth(texel, layer + 1));
        if (depth >= planes_.end(texel)) {
            const float all = map_.optical_depth(texel, planes_.last_plane());
            // In front, the receiver's own too.
            if (planes_.ends_at_last_caster()) return all;
            return all - placed.optical_depth + in_front;
        }
        return among_others(texel, layer, x, placed) + in_front;
    }

   private:
    // Without the receiver's own caster.
    float among_others(std::size_t texel, int layer, float x, const OwnDeposit& own) const {
        switch (interpolation_) {
            case Interpolation::cubic:
                return on_cubic(texel, layer, x, own);
            case Interpolation::mean_depth:
            case Interpolation::mean_depth_of_few:
                return about_mean(texel, layer, x, own);
            default:
                return on_line(texel, layer, x, own);
        }
    }
    // Optical depth grows evenly from one plane to the next.
    float on_line(std::size_t texel, int layer, float x, const OwnDeposit& own) const {
        const std::span<const float> planes = planes_.of(texel);
        const float low = planes[layer], high = planes[layer + 1];
        const float along = (x - low) / (high - low);
        const float part = counted(planes, own.depth, own.depth_end, layer, along);
        const float before = map_.optical_depth(texel, layer);
        const float behind = map_.optical_depth(texel, layer + 1);
        return rising_line(before, behind, along) - own.optical_depth * part;
    }
    float about_mean(std::size_t texel, int layer, float x, const OwnDeposit& own) const {
        const std::span<const float> planes = planes_.of(texel);
        const LayerHeld in_front = without(own, texel, layer);
        const LayerHeld with_layer = without(own, texel, layer + 1);
        const float before = in_front.optical_depth;
        const LayerHeld held{with_layer.optical_depth - before,
                             with_layer.moment - in_front.moment};
        return before + held_in_front(held, planes[layer], planes[layer + 1], x,
                                      interpolation_ == Interpolation::mean_depth_of_few);
    }
    // The receiver's own part is taken out of all four planes first.
    float on_cubic(std::size_t texel, int layer, float x, const OwnDeposit& own) const {
        const std::span<const float> planes = planes_.of(texel);
        std::array<float, 4> places, values;
        for (int i = 0; i < 4; ++i) {
            const int k = std::clamp(layer + i - 1, 0, planes_.last_plane());
            places[i] = planes[k] + float(layer + i - 1 - k);  // outside, all stays as it is
            values[i] = map_.optical_depth(texel, k) - own_part(own, texel, k);
        }
        return monotone_cubic(places, values, x);
    }

    // Of a receiver, what plane k counts.
    float own_part(const OwnDeposit& own, std::size_t texel, int k) const {
        return own.optical_depth * counted_at(planes_.of(texel), k, own.depth, own.depth_end);
    }
    // In front of plane k, where moments are kept.
    LayerHeld without(const OwnDeposit& own, std::size_t texel, int k) const {
        if (k == 0) return {};
        const float part = own_part(own, texel, k);
        const float mean = mean_in_front(planes_.of(texel), k, own.depth, own.depth_end);
        return {map_.optical_depth(texel, k) - part, map_.moment(texel, k) - part * mean};
    }

    const DrawnLayers drawn_;
    LayerPlanes planes_;
    LayerMap map_;
    Interpolation interpolation_;
};

}  // namespace

OnCpu layers_on_cpu(const ShadowInputs& inputs, const DrawnLayers& drawn, const LayerPart& part,
                    int block_stride) {
    return [=](PassContext& context) {
        const LayerPlanes planes{context, drawn};
        const LayerMap map{context, drawn, part.planes, part.moments};
        int first_plane = 1, last_plane = 0;  // those that stand in these targets
        for (int k = 1; k <= planes.last_plane(); ++k) {
            const int target = int(drawn.slot_of(k).target);
            if (target < part.first_target) first_plane = k + 1;
            if (target < part.first_target + part.target_count) last_plane = k;
        }
        LayerSums layers{drawn, planes, map, first_plane, last_plane};
        FragmentSource source = inputs.fragments(context, true);
        source.sample = {block_stride};
        for_each_fragment(source, [&](const Fragment& fragment) { layers.add(fragment); });
        const bool keeps_start = drawn.is_packed && part.planes && part.first_target == 0;
        const TextureDesc& desc = drawn.map.desc();
        parallel_parts(std::size_t(desc.width) * std::size_t(desc.height), std::size_t(desc.width),
                       [&](std::size_t first_texel, std::size_t last_texel) {
                           layers.accumulate(first_texel, last_texel);
                           for (std::size_t texel = first_texel; keeps_start && texel < last_texel;
                                ++texel)
                               map.start(texel) = planes.start(texel);
                       });
    };
}

std::function<void(PassContext&, int plane, const ShapeFilter&)> plane_on_cpu(
    const ShadowInputs& inputs, const DrawnLayers& drawn) {
    return [inputs, drawn](PassContext& context, int plane, const ShapeFilter& wanted) {
        const LayerPlanes planes{context, drawn};
        const LayerMap map{context, drawn};
        std::vector<ShapePtr> shapes;
        for (const ShapePtr& shape : inputs.translucent.shapes())
            if (wanted(*shape)) shapes.push_back(shape);
        for_each_fragment(
            inputs.fragments(context, true).of(shapes), [&](const Fragment& fragment) {
                const std::size_t texel = fragment.texel;
                const float begin = planes.position(texel, fragment.depth);
                const float end = planes.position(texel, fragment.depth_end);
                const auto part = [&](int k) {
                    return k > 0 ? counted_at(planes.of(texel), k, begin, end) : 0.f;
                };
                map.plane(texel, plane) +=
                    map.added(fragment.optical_depth, part(plane), part(plane - planes_per_target));
            });
    };
}

std::function<std::unique_ptr<TexelMap>(PassContext&)> look_up_on_cpu(const DrawnLayers& drawn,
                                                                      Interpolation interpolation) {
    return [drawn, interpolation](PassContext& context) {
        return std::make_unique<LayeredTexels>(context, drawn, interpolation);
    };
}

}  // namespace opacity::techniques
