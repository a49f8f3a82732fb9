// Points as the caller gave them: float32 or float64. They stay so on the CPU; the GPU receives
// float32 relative to an origin that is subtracted in float64 first.
#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <variant>
#include <vector>

#include "opacity/core/math.hpp"
#include "opacity/core/shared.hpp"

namespace opacity {

// No coordinate is larger: products of differences stay finite in float32, so no NaN is ever made.
inline constexpr double max_coordinate = 1e18;

class Positions {
   public:
    using Numbers = std::variant<std::vector<float>, std::vector<double>>;
    Positions() = default;
    // Three numbers a point: x0 y0 z0 x1 ... Copies share them.
    explicit Positions(std::vector<float> xyz) : xyz_{Numbers{std::move(xyz)}} {}
    explicit Positions(std::vector<double> xyz) : xyz_{Numbers{std::move(xyz)}} {}

    std::size_t size() const {
        return std::visit([](const auto& v) { return v.size() / 3; }, *xyz_);
    }
    double3 operator[](std::size_t i) const {
        return std::visit(
            [i](const auto& v) {
                return double3{v[3 * i], v[3 * i + 1], v[3 * i + 2]};
            },
            *xyz_);
    }
    const Numbers& xyz() const { return *xyz_; }

    Box bounds() const;
    // The index of the first point with a coordinate that is NaN or beyond max_coordinate, or
    // size().
    std::size_t first_bad() const;
    // Four floats a point: position minus origin, then w[i] (or w[0] when it is alone).
    std::vector<float> relative_to(const double3& origin, std::span<const float> w) const;

   private:
    Shared<Numbers> xyz_;
};

}  // namespace opacity
