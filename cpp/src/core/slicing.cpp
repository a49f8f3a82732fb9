#include "opacity/core/slicing.hpp"

#include <algorithm>
#include <cmath>
#include <queue>
#include <tuple>

namespace opacity {
namespace {

// Thinner slabs are not halved for their mass: planes are floats.
constexpr double least_thickness = 0x1p-20;

// Of all mass: the halves of an evenly filled cell are equal, however they were rounded.
constexpr double equal_masses = 0x1p-30;

struct Slab {
    double begin = 0.0, end = 1.0, mass = 0.0;

    double thickness() const { return end - begin; }
    // The greatest is the next to be halved: of equals the one nearest to the light.
    bool operator<(const Slab& other) const {
        return std::tuple{mass, thickness(), -begin} <
               std::tuple{other.mass, other.thickness(), -other.begin};
    }
};

// In front of x, evenly spread over each cell.
double mass_before(const DepthHistogram& histogram, double x) {
    double mass = 0.0;
    for (std::size_t i = 0; i < histogram.masses.size(); ++i) {
        const double begin = histogram.planes[i], end = histogram.planes[i + 1];
        mass += histogram.masses[i] * std::clamp((x - begin) / (end - begin), 0.0, 1.0);
    }
    return mass;
}

std::vector<float> as_planes(std::vector<double> places) {
    std::vector<float> planes(places.begin(), places.end());
    planes.front() = 0.f, planes.back() = 1.f;
    return planes;
}

}  // namespace

std::vector<float> uniform_slices(int count) {
    return gamma_slices(count, 1.0);
}

std::vector<float> gamma_slices(int count, double gamma) {
    std::vector<double> places;
    for (int k = 0; k <= count; ++k) places.push_back(std::pow(double(k) / count, gamma));
    return as_planes(std::move(places));
}

std::vector<float> density_slices(int count, const DepthHistogram& histogram) {
    const double unit = equal_masses * mass_before(histogram, 1.0);
    const auto slab = [&](double begin, double end) {
        if (end - begin < least_thickness || !(unit > 0.0)) return Slab{begin, end, 0.0};
        const double mass = mass_before(histogram, end) - mass_before(histogram, begin);
        return Slab{begin, end, std::round(mass / unit)};
    };
    std::priority_queue<Slab> slabs;
    slabs.push(slab(0.0, 1.0));
    std::vector<double> places{0.0, 1.0};
    while (int(places.size()) <= count) {
        const Slab densest = slabs.top();
        slabs.pop();
        const double middle = 0.5 * (densest.begin + densest.end);
        slabs.push(slab(densest.begin, middle));
        slabs.push(slab(middle, densest.end));
        places.push_back(middle);
    }
    std::sort(places.begin(), places.end());
    return as_planes(std::move(places));
}

std::vector<float> planes_of_sizes(std::span<const double> sizes) {
    double total = 0.0, place = 0.0;
    for (const double size : sizes) total += size;
    std::vector<double> places{0.0};
    for (const double size : sizes) places.push_back((place += size) / total);
    return as_planes(std::move(places));
}

}  // namespace opacity
