#include "opacity/core/optical_depth_profiles.hpp"

#include <algorithm>
#include <cmath>

namespace opacity {
namespace {

double fragment_optical_depth(const OpticalDepthProfiles& profiles) {
    double sum = 0.0;
    std::size_t count = 0;
    for (std::size_t t = 0; t < profiles.texel_count(); ++t) {
        const std::span<const float> texel = profiles.texel(t);
        const auto cell = [&](std::size_t k) {
            return at_plane(texel, k + 1) - at_plane(texel, k);
        };
        for (std::size_t k = 0; k < texel.size(); ++k) {
            const bool alone = cell(k) > 0.0 && (k == 0 || cell(k - 1) == 0.0) &&
                               (k + 1 == texel.size() || cell(k + 1) == 0.0);
            if (!alone) continue;
            sum += cell(k);
            ++count;
        }
    }
    return count ? sum / double(count) : 0.0;
}

}  // namespace

PlaneCell cell_of(std::span<const float> planes, double x) {
    const auto above = std::upper_bound(planes.begin() + 1, planes.end() - 1, x);
    const std::size_t index = std::size_t(above - planes.begin()) - 1;
    const double begin = planes[index], end = planes[index + 1];
    return {index, std::clamp((x - begin) / (end - begin), 0.0, 1.0)};
}

FineProfiles::FineProfiles(const OpticalDepthProfiles& profiles)
    : profiles_{profiles}, fragment_{fragment_optical_depth(profiles)} {}

double FineProfiles::fragment_of(double cell) const {
    return fragment_ > 0.0 ? cell / std::max(1.0, std::round(cell / fragment_)) : 0.0;
}

double FineProfiles::in_front(std::span<const float> texel, double x) const {
    const PlaneCell cell = cell_of(profiles_.planes, x);
    double begin = at_plane(texel, cell.index), end = at_plane(texel, cell.index + 1);
    const double inside = end - begin;
    if (cell.index == 0) begin += fragment_of(inside);
    if (cell.index + 1 == texel.size()) end -= fragment_of(inside);
    return std::lerp(begin, std::max(begin, end), cell.along);
}

std::vector<float> FineProfiles::rebinned(std::span<const float> planes) const {
    const std::size_t layers = planes.size() - 1;
    std::vector<float> values(profiles_.texel_count() * layers, 0.f);
    for (std::size_t t = 0; t < profiles_.texel_count(); ++t) {
        const std::span<const float> texel = profiles_.texel(t);
        if (!is_covered(texel)) continue;
        float* value = &values[t * layers];
        for (std::size_t k = 1; k < layers; ++k) *value++ = float(in_front(texel, planes[k]));
        *value = texel.back();
    }
    return values;
}

}  // namespace opacity
