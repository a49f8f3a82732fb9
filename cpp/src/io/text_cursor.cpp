#include "io/text_cursor.hpp"

#include <algorithm>
#include <cmath>

#include "io/parsed_number.hpp"
#include "opacity/scene/positions.hpp"

namespace opacity {
namespace {

bool is_blank(char c) {
    return c == ' ' || c == '\t' || c == '\r';
}

// A damaged line may be megabytes long; a message is not.
std::string quoted(std::string_view word) {
    constexpr std::size_t longest = 40;
    std::string text{'"'};
    text.append(word.substr(0, longest)).append(word.size() > longest ? "...\"" : "\"");
    return text;
}

}  // namespace

TextCursor::TextCursor(const std::filesystem::path& path, std::string_view text)
    : name_{path.string()}, text_{text} {
    constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
    if (text_.starts_with(byte_order_mark)) text_.remove_prefix(byte_order_mark.size());
}

std::size_t TextCursor::continuation() const {
    if (text_[at_] != '\\') return 0;
    const std::string_view ahead = text_.substr(at_, 3);
    if (ahead.starts_with("\\\n")) return 2;
    return ahead.starts_with("\\\r\n") ? 3 : 0;
}

void TextCursor::skip_blanks() {
    while (at_ < text_.size()) {
        if (is_blank(text_[at_])) {
            ++at_;
        } else if (const std::size_t length = continuation()) {
            at_ += length;
            ++line_;
        } else {
            return;
        }
    }
}

bool TextCursor::next_statement() {
    while (in_statement_ && !word().empty()) {
    }
    skip_blanks();
    while (at_ < text_.size()) {
        if (text_[at_] == '\n') {
            ++at_;
            ++line_;
        } else if (text_[at_] == '#') {
            at_ = std::min(text_.find('\n', at_), text_.size());
        } else {
            return in_statement_ = true;
        }
        skip_blanks();
    }
    return in_statement_ = false;
}

std::string_view TextCursor::word() {
    skip_blanks();
    const std::size_t begin = at_;
    if (at_ < text_.size() && text_[at_] == '#') return {};
    while (at_ < text_.size() && !is_blank(text_[at_]) && text_[at_] != '\n' && !continuation())
        ++at_;
    return text_.substr(begin, at_ - begin);
}

std::string_view TextCursor::rest() {
    skip_blanks();
    const std::size_t begin = at_;
    at_ = std::min(text_.find('\n', at_), text_.size());
    std::size_t end = at_;
    while (end > begin && is_blank(text_[end - 1])) --end;
    return text_.substr(begin, end - begin);
}

double TextCursor::number(const char* what) {
    const std::string_view text = word();
    const std::optional<double> value = parsed_number(text);
    if (value && std::abs(*value) <= max_coordinate) return *value;
    const std::string found = text.empty() ? "is missing" : "is " + quoted(text);
    throw error(std::string{what} + " " + found, "write a finite number of at most 1e18 in size");
}

FileFormatError TextCursor::error(const std::string& problem, const std::string& fix) const {
    return {name_ + ":" + std::to_string(line_) + ": " + problem, fix};
}

}  // namespace opacity
