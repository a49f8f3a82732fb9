#include "core/number_text.hpp"

#include <charconv>
#include <cmath>

namespace opacity {
namespace {

template <class Number>
std::string shortest(Number value) {
    // to_chars by itself counts characters only, and writes 100000 as 1e+05.
    const double size = std::abs(double(value));
    const bool is_plain = size == 0.0 || (size >= 1e-4 && size < 1e15);
    char text[32];  // holds the longest of either form
    const auto format = is_plain ? std::chars_format::fixed : std::chars_format::scientific;
    const auto written = std::to_chars(text, text + sizeof text, value, format);
    return {text, written.ptr};
}

}  // namespace

std::string number_text(double value) {
    return shortest(value);
}

std::string number_text(float value) {
    return shortest(value);
}

}  // namespace opacity
