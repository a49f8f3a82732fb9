#include "rays/footprint.hpp"

#include <algorithm>
#include <cmath>

#include "io/random.hpp"

namespace opacity::rays {

std::array<double, 2> footprint_offset(std::size_t point, int sample, int samples) {
    const int rows = std::max(1, int(std::sqrt(double(samples))));
    // Row r holds the samples first .. next - 1, and is as high as they are many.
    const auto first_of = [&](int r) { return int(std::int64_t{r} * samples / rows); };
    int row = int(std::int64_t{sample} * rows / samples);
    while (first_of(row + 1) <= sample) ++row;
    const int first = first_of(row), count = first_of(row + 1) - first;
    Random random{point, std::uint64_t(sample)};
    const double across = random.uniform(), up = random.uniform();
    return {(sample - first + across) / count - 0.5, (first + up * count) / samples - 0.5};
}

}  // namespace opacity::rays
