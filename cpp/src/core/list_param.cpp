#include "opacity/core/list_param.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

namespace opacity {
namespace {

std::optional<double> positive_number(std::string_view text) {
    while (text.starts_with(' ')) text.remove_prefix(1);
    while (text.ends_with(' ')) text.remove_suffix(1);
    double number = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    const bool is_whole = error == std::errc{} && end == text.data() + text.size();
    return is_whole && std::isfinite(number) && number > 0.0 ? std::optional{number} : std::nullopt;
}

// Empty where one of them is none.
std::vector<double> positive_numbers(std::string_view text) {
    std::vector<double> numbers;
    for (bool more = true; more;) {
        const std::size_t comma = text.find(',');
        const auto number = positive_number(text.substr(0, comma));
        if (!number) return {};
        numbers.push_back(*number);
        more = comma != std::string_view::npos;
        if (more) text.remove_prefix(comma + 1);
    }
    return numbers;
}

}  // namespace

std::string ListParam::range() const {
    std::string list;
    for (const std::string& word : words_) list += "\"" + word + "\", ";
    return list + "or numbers above 0";
}

void ListParam::assign(const ParamValue& value) {
    if (std::holds_alternative<bool>(value)) reject_type(value);
    const auto* given = std::get_if<std::string>(&value);
    std::string text = given ? *given : to_string(value);
    std::vector<double> numbers;
    if (std::find(words_.begin(), words_.end(), text) == words_.end()) {
        numbers = positive_numbers(text);
        if (numbers.empty()) reject(value, "not one of " + range());
    }
    if (text == text_) return;
    text_ = std::move(text);
    numbers_ = std::move(numbers);
    touch();
}

}  // namespace opacity
