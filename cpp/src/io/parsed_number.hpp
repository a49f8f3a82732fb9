// Words as numbers.
#pragma once

#include <charconv>
#include <optional>
#include <string_view>

namespace opacity {

// Nothing unless all of the word is one. Unlike strtod it reads the point in every locale.
inline std::optional<double> parsed_number(std::string_view word) {
    // from_chars knows no plus sign.
    if (word.starts_with('+') && !word.starts_with("+-")) word.remove_prefix(1);
    double value = 0.0;
    const char* end = word.data() + word.size();
    const auto [stop, failure] = std::from_chars(word.data(), end, value);
    if (failure != std::errc{} || stop != end) return std::nullopt;
    return value;
}

}  // namespace opacity
