// What a number given by a caller may be; NaN is never allowed.
#pragma once

#include <cstddef>
#include <limits>
#include <span>
#include <string>

#include "opacity/core/math.hpp"

namespace opacity {

struct Allowed {
    double min, max;
    const char* words;  // ends the sentence "opacity[3] = 1.5 is not ..."

    bool operator()(double value) const { return value >= min && value <= max; }
};

inline constexpr double largest_float = std::numeric_limits<float>::max();
inline constexpr Allowed unit_interval{0.0, 1.0, "in 0..1"};
inline constexpr Allowed not_negative{0.0, largest_float, "finite and at least 0"};
// Of a colour, and of the factor of one: products of three stay far from float's end.
inline constexpr Allowed brightness{0.0, 1e9, "in 0..1e9"};
inline constexpr Allowed any_finite{-largest_float, largest_float, "finite"};

// The index of the first value that is not allowed, or values.size().
std::size_t first_refused(std::span<const float> values, const Allowed& allowed);

// ParameterError naming the first refused element; one element is `width` values.
void check_values(const char* name, std::span<const float> values, const Allowed& allowed,
                  std::size_t width = 1);
void check_value(const char* name, double value, const Allowed& allowed);
void check_value(const char* name, float value, const Allowed& allowed);
// For points and directions: every coordinate at most max_coordinate in size.
void check_vector(const char* name, const double3& vector);

// The same numbers, one after the other.
std::span<const float> flat(std::span<const float3> values);
std::span<const float> flat(std::span<const float2> values);

}  // namespace opacity
