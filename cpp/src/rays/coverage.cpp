#include "rays/coverage.hpp"

#include <cmath>

namespace opacity::rays {
namespace {

// The two texels around a place in a map that repeats, and the way from the one to the other.
struct Between {
    int first, second;
    double along;
};

Between between(double u, int size) {
    const double at = (u - std::floor(u)) * size - 0.5;
    const int below = int(std::floor(at));
    return {(below + size) % size, (below + 1) % size, at - below};
}

}  // namespace

double Coverage::texel(int x, int y) const {
    const float alpha = map_->values[std::size_t(y) * std::size_t(map_->width) + std::size_t(x)];
    return mode_ == AlphaMode::mask ? double(alpha >= cutoff_) : double(alpha);
}

double Coverage::at(const std::array<double, 2>& uv) const {
    const Between x = between(uv[0], map_->width), y = between(uv[1], map_->height);
    const auto row = [&](int j) {
        return std::lerp(texel(x.first, j), texel(x.second, j), x.along);
    };
    return std::lerp(row(y.first), row(y.second), y.along);
}

}  // namespace opacity::rays
