#include "scene/strand_ranks.hpp"

#include <algorithm>
#include <numeric>

#include "scene/space_curve.hpp"

namespace opacity {
namespace {

// The digits of a whole number behind the point, the lowest first (van der Corput 1935).
double radical_inverse(std::uint64_t number) {
    double sum = 0.0;
    for (double digit = 0.5; number > 0; number >>= 1, digit *= 0.5)
        if (number & 1) sum += digit;
    return sum;
}

double3 middle_of(const Strands& strands, std::size_t strand) {
    const std::size_t begin = std::size_t(strands.offsets()[strand]);
    const std::size_t end = std::size_t(strands.offsets()[strand + 1]);
    double3 sum{};
    for (std::size_t i = begin; i < end; ++i) {
        const double3 p = strands.points()[i];
        for (std::size_t axis = 0; axis < 3; ++axis) sum[axis] += p[axis] / double(end - begin);
    }
    return sum;
}

}  // namespace

std::size_t StrandRanks::kept(double detail) const {
    return std::size_t(std::lower_bound(sorted.begin(), sorted.end(), detail) - sorted.begin());
}

double StrandRanks::widening(double detail) const {
    return sorted.empty() ? 1.0 : double(sorted.size()) / double(kept(detail));
}

StrandRanks ranks_of(const Strands& strands) {
    const Box box = strands.points().bounds();
    const std::size_t count = strands.strand_count();
    std::vector<std::uint64_t> places(count);
    for (std::size_t k = 0; k < count; ++k) places[k] = place_on_curve(middle_of(strands, k), box);
    std::vector<std::size_t> order(count);
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return places[a] < places[b]; });
    StrandRanks ranks;
    ranks.of_strands.resize(count);
    for (std::size_t i = 0; i < count; ++i) ranks.of_strands[order[i]] = radical_inverse(i);
    ranks.sorted = ranks.of_strands;
    std::sort(ranks.sorted.begin(), ranks.sorted.end());
    return ranks;
}

double widening_of(const Shape& shape, double detail) {
    const auto* strands = dynamic_cast<const Strands*>(&shape);
    return strands && detail < 1.0 ? strands->ranks()->widening(detail) : 1.0;
}

double caster_reach(const Shape& shape, double detail) {
    return shape.margin() * shape.scale() * widening_of(shape, detail);
}

std::vector<std::size_t> strand_numbers(const Strands& strands) {
    std::vector<std::size_t> numbers;
    numbers.reserve(strands.segments().size());
    std::size_t strand = 0;
    for (const std::uint32_t first : strands.segments()) {
        while (std::int64_t(first) >= strands.offsets()[strand + 1]) ++strand;
        numbers.push_back(strand);
    }
    return numbers;
}

}  // namespace opacity
