#include "scene/check.hpp"

#include <algorithm>

#include "core/number_text.hpp"
#include "opacity/core/error.hpp"
#include "opacity/scene/positions.hpp"

namespace opacity {
namespace {

template <class Number>
[[noreturn]] void refuse(const std::string& what, Number value, const Allowed& allowed) {
    throw ParameterError(what + " = " + number_text(value) + " is not " + allowed.words,
                         std::string{"pass values that are "} + allowed.words);
}

}  // namespace

std::size_t first_refused(std::span<const float> values, const Allowed& allowed) {
    const auto bad = std::find_if_not(values.begin(), values.end(), allowed);
    return static_cast<std::size_t>(bad - values.begin());
}

void check_values(const char* name, std::span<const float> values, const Allowed& allowed,
                  std::size_t width) {
    const std::size_t bad = first_refused(values, allowed);
    if (bad == values.size()) return;
    refuse(std::string{name} + "[" + std::to_string(bad / width) + "]", values[bad], allowed);
}

void check_value(const char* name, double value, const Allowed& allowed) {
    if (!allowed(value)) refuse(name, value, allowed);
}

void check_value(const char* name, float value, const Allowed& allowed) {
    if (!allowed(value)) refuse(name, value, allowed);
}

void check_vector(const char* name, const double3& vector) {
    constexpr Allowed coordinate{-max_coordinate, max_coordinate,
                                 "finite and at most 1e18 in size"};
    for (std::size_t i = 0; i < vector.size(); ++i)
        if (!coordinate(vector[i]))
            refuse(std::string{name} + "." + "xyz"[i], vector[i], coordinate);
}

std::span<const float> flat(std::span<const float3> values) {
    static_assert(sizeof(float3) == 3 * sizeof(float));
    return values.empty() ? std::span<const float>{}
                          : std::span{values[0].data(), 3 * values.size()};
}

std::span<const float> flat(std::span<const float2> values) {
    static_assert(sizeof(float2) == 2 * sizeof(float));
    return values.empty() ? std::span<const float>{}
                          : std::span{values[0].data(), 2 * values.size()};
}

}  // namespace opacity
