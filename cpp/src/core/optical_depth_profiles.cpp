#include "opacity/core/optical_depth_profiles.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

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

// What a cell holds at most, with a probability of 95 %, if it holds any, and if chance alone
// spreads fragments over cells of which this part holds some.
std::size_t most_by_chance(double occupied) {
    if (occupied >= 1.0) return std::numeric_limits<std::size_t>::max();
    const double mean = -std::log1p(-occupied);  // of a Poisson distribution
    std::size_t most = 0;
    for (double more = occupied, exactly = 1.0 - occupied; more > 0.05 * occupied;) {
        exactly *= mean / double(++most);
        more -= exactly;
    }
    return std::max<std::size_t>(most, 1);
}

double occupied_part(std::span<const float> texel) {
    std::size_t occupied = 0;
    for (std::size_t k = 0; k < texel.size(); ++k)
        occupied += at_plane(texel, k + 1) > at_plane(texel, k);
    return double(occupied) / double(texel.size());
}

}  // namespace

PlaneCell cell_of(std::span<const float> planes, double x) {
    const auto above = std::upper_bound(planes.begin() + 1, planes.end() - 1, x);
    const std::size_t index = std::size_t(above - planes.begin()) - 1;
    const double begin = planes[index], end = planes[index + 1];
    return {index, std::clamp((x - begin) / (end - begin), 0.0, 1.0)};
}

FineProfiles::FineProfiles(const OpticalDepthProfiles& profiles)
    : profiles_{profiles}, fragment_{fragment_optical_depth(profiles)} {
    for (std::size_t t = 0; t < profiles.texel_count(); ++t) {
        const std::span<const float> texel = profiles.texel(t);
        most_.push_back(most_by_chance(occupied_part(texel)));
        for (std::size_t k = 0; k < texel.size(); ++k) {
            const double all = at_plane(texel, k + 1) - at_plane(texel, k);
            const int on_planes = (k == 0) + (k + 1 == texel.size());
            inside_.push_back(std::max(0.0, all - on_planes * fragment_of(texel, all)));
        }
    }
}

double FineProfiles::fragment_of(std::span<const float> texel, double cell) const {
    if (!(fragment_ > 0.0)) return 0.0;
    const double most = double(most_[index_of(texel)]);
    return cell / std::clamp(std::round(cell / fragment_), 1.0, most);
}

double FineProfiles::in_front(std::span<const float> texel, double x) const {
    const PlaneCell cell = cell_of(profiles_.planes, x);
    double begin = at_plane(texel, cell.index);
    const double all = at_plane(texel, cell.index + 1) - begin;
    if (cell.index == 0) begin += fragment_of(texel, all);
    return begin + cell.along * inside(texel, cell.index);
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

// The first caster's is 0.
std::vector<float> FineProfiles::rebinned_moments(std::span<const float> planes) const {
    const std::span<const float> cells = profiles_.planes;
    std::vector<float> result;
    result.reserve(profiles_.texel_count() * (planes.size() - 1));
    for (std::size_t t = 0; t < profiles_.texel_count(); ++t) {
        const std::span<const float> texel = profiles_.texel(t);
        if (!is_covered(texel)) {
            result.resize(result.size() + planes.size() - 1, 0.f);
            continue;
        }
        std::size_t cell = 0;
        double before = 0.0;  // of whole cells
        for (std::size_t k = 1; k + 1 < planes.size(); ++k) {
            const auto part = [&](double end) {
                return inside(texel, cell) * (end - cells[cell]) / (cells[cell + 1] - cells[cell]) *
                       0.5 * (cells[cell] + end);
            };
            for (; cells[cell + 1] < planes[k]; ++cell) before += part(cells[cell + 1]);
            result.push_back(float(before + part(planes[k])));
        }
        for (; cell < texel.size(); ++cell)
            before += inside(texel, cell) * 0.5 * (cells[cell] + cells[cell + 1]);
        const double last = texel.back() - at_plane(texel, texel.size() - 1);
        result.push_back(float(before + fragment_of(texel, last)));
    }
    return result;
}

}  // namespace opacity
