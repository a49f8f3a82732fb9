#include "io/ply_body.hpp"

#include <algorithm>
#include <cmath>

#include "io/parsed_number.hpp"

namespace opacity {

FileFormatError PlyBody::error(const std::string& problem) const {
    return {name_ + " " + problem,
            "the file is damaged or was not written to the end: export or copy it again"};
}

double PlyBody::next(ScalarType type) {
    if (encoding_ != PlyEncoding::ascii) {
        const std::size_t size = size_of(type);
        if (content_.size() - at_ < size) throw error("ends within its numbers");
        const auto* bytes = reinterpret_cast<const std::byte*>(content_.data() + at_);
        at_ += size;
        return scalar_at(
            bytes, type,
            encoding_ == PlyEncoding::little_endian ? std::endian::little : std::endian::big);
    }
    constexpr std::string_view blanks = " \t\r\n";
    at_ = std::min(content_.find_first_not_of(blanks, at_), content_.size());
    if (at_ == content_.size()) throw error("ends within its numbers");
    const std::size_t end = std::min(content_.find_first_of(blanks, at_), content_.size());
    const std::string_view word = content_.substr(at_, end - at_);
    at_ = end;
    if (const std::optional<double> value = parsed_number(word)) return *value;
    throw error("holds \"" + std::string{word.substr(0, 40)} + "\" where a number belongs");
}

std::size_t PlyBody::next_count(const PlyProperty& list) {
    const double count = next(*list.count_type);
    const auto room = double((content_.size() - at_) / least_size(list.type));
    if (count >= 0.0 && count <= room && count == std::floor(count)) return std::size_t(count);
    throw error("holds a list of more numbers than it has, or of no whole number of them");
}

void PlyBody::skip(const PlyProperty& property) {
    const std::size_t count = property.count_type ? next_count(property) : 1;
    for (std::size_t i = 0; i < count; ++i) next(property.type);
}

// Of text, a digit and what parts it from the next; the last one may end the file.
std::size_t PlyBody::least_size(ScalarType type) const {
    return encoding_ == PlyEncoding::ascii ? 1 : size_of(type);
}

std::size_t PlyBody::least_size(const PlyProperty& property) const {
    return least_size(property.count_type.value_or(property.type));
}

void PlyBody::check_room(const PlyElement& element) const {
    std::size_t size = 0;
    for (const PlyProperty& property : element.properties) size += least_size(property);
    const std::size_t left = content_.size() - at_;
    if (element.count == 0 || (size > 0 && element.count <= left / size)) return;
    throw error("announces " + std::to_string(element.count) + " of " + element.name.substr(0, 40) +
                ", more than its " + std::to_string(left) + " bytes behind the header can hold");
}

}  // namespace opacity
