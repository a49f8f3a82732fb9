#include "scene/map_detail.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "core/vector.hpp"
#include "scene/strand_ranks.hpp"
#include "scene/texel_side.hpp"

namespace opacity {
namespace {

// Over how many texels a bilinear look-up averages across a strand: as a box of half as much again
// would, by its variance.
constexpr double look_up_texels = 1.5;
// Sampling adds most where a receiver has about this much in front, on the mean.
constexpr double worst_optical_depth = 0.9;
constexpr double least_detail = 1e-3;
constexpr double most_opacity = 0.999;
// Of lengths, that all directions show on the mean.
constexpr double seen_part = std::numbers::pi / 4.0;
constexpr int halvings = 40;

// Finest of all splits, or faces, in the middle of the scene.
double finest_texel(const LightSpace& space, const Scene& scene) {
    double finest = 1.0;
    for (const LightSplit& split : space.splits) finest = std::max(finest, split.scale);
    LightSpace whole = space;
    whole.splits.clear();
    return texel_side(whole, scene.bounds().center()) / finest;
}

std::string told(double widening, const char* how) {
    char text[160];
    std::snprintf(text, sizeof text, "1 of %.3g strands, %.3g times as wide: %s", widening,
                  widening, how);
    return text;
}

}  // namespace

double sampling_error(double widening, double opacity, double optical_depth) {
    if (!(opacity > 0.0)) return 0.0;
    const double a = std::min(opacity, most_opacity), omega = std::max(optical_depth, 1e-9);
    const double ratio = a / (1.0 - a);
    const double k = (widening - 1.0) * ratio * ratio / -std::log1p(-a);
    // Mean of exp(-2 x) (exp(k x) - 1) over x from 0 to omega.
    const double rise = k - 2.0;
    const double grown = std::abs(rise) < 1e-9 ? omega : std::expm1(rise * omega) / rise;
    return std::sqrt(std::max(grown + 0.5 * std::expm1(-2.0 * omega), 0.0) / omega);
}

MapDetailRule::Sums MapDetailRule::sums_of(const Strands& strands) {
    const std::vector<float>&width = strands.width(), &opacity = strands.opacity();
    const auto at = [](const std::vector<float>& values, std::size_t i) {
        return double(values.size() > 1 ? 0.5f * (values[i] + values[i + 1]) : values[0]);
    };
    Sums sums;
    for (const std::uint32_t first : strands.segments()) {
        const double3 root = transform_point(strands.transform(), strands.points()[first]);
        const double3 tip = transform_point(strands.transform(), strands.points()[first + 1]);
        const double area = distance(root, tip) * at(width, first) * strands.scale();
        const double o = at(opacity, first);
        sums.optical_area += area * -std::log1p(-std::min(o, most_opacity));
        sums.opaque_area += area * o;
        sums.squared += area * o * at(width, first) * strands.scale() * o;
    }
    return sums;
}

const MapDetailRule::Sums& MapDetailRule::measured(const Strands& strands) {
    Measured& known = measured_[&strands];
    const Shape::Revisions& now = strands.revisions();
    const bool is_known = known.geometry == now.geometry && known.transform == now.transform &&
                          known.opacity == now.opacity;
    if (!is_known) known = {now.geometry, now.transform, now.opacity, sums_of(strands)};
    return known.sums;
}

// The least detail within the error, by halving.
double MapDetailRule::find(const Scene& scene, const LightSpace& space) {
    Sums all;
    double most = 0.0;
    for (const ShapePtr& shape : scene.shapes()) {
        const auto* strands = dynamic_cast<const Strands*>(shape.get());
        if (!strands) continue;
        const auto lock = strands->lock();
        if (!strands->is_caster()) continue;
        const Sums& sums = measured(*strands);
        all.optical_area += sums.optical_area;
        all.opaque_area += sums.opaque_area;
        all.squared += sums.squared;
        most = std::max(most, double(std::ranges::max(strands->opacity())));
    }
    if (!(all.opaque_area > 0.0)) return 1.0;
    const double side = finest_texel(space, scene), window = space.map_size_px * side;
    const double opacity = std::min(all.squared / all.opaque_area / (look_up_texels * side), most);
    const double optical_depth = std::max(
        seen_part * all.optical_area / (space.faces_an_eye * window * window), worst_optical_depth);
    double fits = 1.0, too_wide = 1.0 / least_detail;
    for (int i = 0; i < halvings; ++i) {
        const double middle = 0.5 * (fits + too_wide);
        const bool within = sampling_error(middle, opacity, optical_depth) <= most_error;
        (within ? fits : too_wide) = middle;
    }
    return 1.0 / fits;
}

MapDetail MapDetailRule::choose(const Scene& scene, const LightSpace& space,
                                const AutoParam<double>& map_detail) {
    std::erase_if(measured_, [&](const auto& entry) {
        return std::ranges::none_of(scene.shapes(),
                                    [&](const auto& s) { return s.get() == entry.first; });
    });
    const bool is_auto = map_detail.is_auto();
    // As shaders see it, who compare ranks with it.
    const double detail = double(float(is_auto ? find(scene, space) : map_detail.get()));
    if (detail >= 1.0) return {1.0, is_auto ? "all strands: fewer would add more than .02" : ""};
    return {detail, told(1.0 / detail, is_auto ? "adds .02 at most" : "as set")};
}

}  // namespace opacity
