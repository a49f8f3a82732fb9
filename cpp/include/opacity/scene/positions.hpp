// Points as the caller gave them: float32 or float64. They stay so on the CPU; the GPU receives
// float32 relative to an origin that is subtracted in float64 first.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <utility>
#include <variant>
#include <vector>

#include "opacity/core/math.hpp"

namespace opacity {

// No coordinate is larger: products of differences stay finite in float32, so no NaN is ever made.
inline constexpr double max_coordinate = 1e18;

class Positions {
   public:
    using Numbers = std::variant<std::span<const float>, std::span<const double>>;
    Positions() = default;
    // Three numbers a point: x0 y0 z0 x1 ... Copies share them.
    explicit Positions(std::vector<float> xyz) : Positions{kept(std::move(xyz))} {}
    explicit Positions(std::vector<double> xyz) : Positions{kept(std::move(xyz))} {}
    // Numbers that stay the caller's, who keeps them as they are while any copy of these lives.
    static Positions borrowed(const Numbers& xyz) { return Positions{Held{xyz, nullptr}}; }

    // Hands the numbers, all of one type, to what goes through them.
    template <class Use>
    decltype(auto) visit(Use&& use) const {
        return std::visit(use, xyz_);
    }
    std::size_t size() const {
        return visit([](const auto& v) { return v.size() / 3; });
    }
    double3 operator[](std::size_t i) const {
        return visit([i](const auto& v) { return double3{v[3 * i], v[3 * i + 1], v[3 * i + 2]}; });
    }
    const Numbers& xyz() const { return xyz_; }

    Box bounds() const;
    // The index of the first point with a coordinate that is NaN or beyond max_coordinate, or
    // size().
    std::size_t first_bad() const;
    // Four floats a point: position minus origin, then w[i] (or w[0] when it is alone).
    std::vector<float> relative_to(const double3& origin, std::span<const float> w) const;

   private:
    struct Held {
        Numbers xyz;
        std::shared_ptr<const void> owner;  // none: the caller
    };
    explicit Positions(Held held) : xyz_{held.xyz}, owner_{std::move(held.owner)} {}
    template <class T>
    static Held kept(std::vector<T> xyz) {
        const auto owner = std::make_shared<const std::vector<T>>(std::move(xyz));
        return {std::span<const T>{*owner}, owner};
    }

    Numbers xyz_;
    std::shared_ptr<const void> owner_;
};

}  // namespace opacity
