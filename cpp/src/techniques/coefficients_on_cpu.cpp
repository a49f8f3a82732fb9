#include "techniques/coefficients_on_cpu.hpp"

#include <algorithm>
#include <array>

#include "map/depth_bits.hpp"
#include "map/fragments.hpp"
#include "techniques/texel_spans.hpp"

namespace opacity::techniques {
namespace {

using Storage = std::array<float, most_coefficients>;

// Never less than nothing, nor more than of all.
class CoefficientTexels : public TexelMap {
   public:
    CoefficientTexels(PassContext& context, const Coefficients& coefficients)
        : values_{context.memory<float>(coefficients.map)},
          spans_{context, coefficients.span},
          texel_count_{values_.size() / std::size_t(4 * coefficients.targets())},
          count_{std::size_t(coefficients.count)},
          expansion_{coefficients.expansion} {}

    float optical_depth(std::size_t texel, float depth, const OwnDeposit& own) const override {
        if (!(depth > spans_.start(texel))) return 0.f;
        Storage storage;
        const std::span<float> c = std::span{storage}.first(count_);
        for (std::size_t k = 0; k < count_; ++k)
            c[k] = values_[(k / 4 * texel_count_ + texel) * 4 + k % 4];
        if (own.optical_depth > 0.f) take_out(texel, own, c);
        const float of_others = expansion_->optical_depth(c);
        const float all = std::max(of_others + own.optical_depth, 0.f);
        float before = of_others;
        if (depth < spans_.end(texel))
            before = expansion_->optical_depth_before(spans_.position(texel, depth), c, all);
        return std::clamp(before, 0.f, all) + std::min(own_in_front(own, depth), all);
    }

   private:
    void take_out(std::size_t texel, const OwnDeposit& own, std::span<float> c) const {
        Storage mine;
        expansion_->of_caster(spans_.position(texel, own.depth),
                              spans_.position(texel, own.depth_end),
                              std::span{mine}.first(c.size()));
        for (std::size_t k = 0; k < c.size(); ++k) c[k] -= own.optical_depth * mine[k];
    }

    std::span<const float> values_;
    TexelSpans spans_;
    std::size_t texel_count_, count_;
    std::shared_ptr<const Expansion> expansion_;
};

}  // namespace

std::function<void(PassContext&)> coefficients_on_cpu(const ShadowInputs& inputs,
                                                      const Coefficients& coefficients,
                                                      int first_target, int target_count) {
    return [=](PassContext& context) {
        const TexelSpans spans{context, coefficients.span};
        const std::span<float> map = context.memory<float>(coefficients.map);
        const std::size_t layer = map.size() / std::size_t(coefficients.targets());
        const auto first = std::size_t(4 * first_target);
        const auto last =
            std::min(first + std::size_t(4 * target_count), std::size_t(coefficients.count));
        for_each_fragment(inputs.fragments(context, true), [&](const Fragment& fragment) {
            const std::size_t texel = fragment.texel;
            Storage c;
            coefficients.expansion->of_caster(spans.position(texel, fragment.depth),
                                              spans.position(texel, fragment.depth_end),
                                              std::span{c}.first(std::size_t(coefficients.count)));
            for (std::size_t k = first; k < last; ++k)
                map[k / 4 * layer + 4 * texel + k % 4] += fragment.optical_depth * c[k];
        });
        if (coefficients.map.desc().format != Format::rgba16f) return;
        const auto here =
            map.subspan(std::size_t(first_target) * layer, std::size_t(target_count) * layer);
        std::transform(here.begin(), here.end(), here.begin(), rounded_to_half);
    };
}

std::function<std::unique_ptr<TexelMap>(PassContext&)> look_up_on_cpu(
    const Coefficients& coefficients) {
    return [coefficients](PassContext& context) {
        return std::make_unique<CoefficientTexels>(context, coefficients);
    };
}

}  // namespace opacity::techniques
