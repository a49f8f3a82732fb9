#include "io/ply_header.hpp"

#include <algorithm>
#include <charconv>

#include "opacity/core/error.hpp"

namespace opacity {
namespace {

struct TypeName {
    std::string_view name;
    ScalarType type;
};
constexpr TypeName type_names[] = {
    {"char", ScalarType::int8},      {"int8", ScalarType::int8},
    {"uchar", ScalarType::uint8},    {"uint8", ScalarType::uint8},
    {"short", ScalarType::int16},    {"int16", ScalarType::int16},
    {"ushort", ScalarType::uint16},  {"uint16", ScalarType::uint16},
    {"int", ScalarType::int32},      {"int32", ScalarType::int32},
    {"uint", ScalarType::uint32},    {"uint32", ScalarType::uint32},
    {"float", ScalarType::float32},  {"float32", ScalarType::float32},
    {"double", ScalarType::float64}, {"float64", ScalarType::float64}};

// Line by line and word by word.
class HeaderReader {
   public:
    HeaderReader(std::string_view content, const std::string& name)
        : content_{content}, name_{name} {}

    PlyHeader read();

   private:
    std::vector<std::string_view> next_line();
    void read_statement(const std::vector<std::string_view>& words);
    void read_format(const std::vector<std::string_view>& words);
    void read_element(const std::vector<std::string_view>& words);
    void read_property(const std::vector<std::string_view>& words);
    ScalarType type(std::string_view word) const;
    FileFormatError error(const std::string& problem) const {
        return {name_ + ":" + std::to_string(line_) + ": " + problem,
                "the header is damaged or of another format: export the file again"};
    }

    std::string_view content_;
    const std::string& name_;
    std::size_t line_ = 0;
    bool has_format_ = false;
    PlyHeader header_;
};

std::vector<std::string_view> HeaderReader::next_line() {
    const std::size_t end = content_.find('\n', header_.size);
    ++line_;
    if (end == content_.npos) throw error("the file ends within its header");
    const std::string_view line = content_.substr(header_.size, end - header_.size);
    header_.size = end + 1;
    std::vector<std::string_view> words;
    for (std::size_t at = line.find_first_not_of(" \t\r"); at != line.npos;) {
        const std::size_t stop = std::min(line.find_first_of(" \t\r", at), line.size());
        words.push_back(line.substr(at, stop - at));
        at = line.find_first_not_of(" \t\r", stop);
    }
    return words;
}

PlyHeader HeaderReader::read() {
    if (!content_.starts_with("ply")) {
        line_ = 1;
        throw error("does not begin with ply");
    }
    next_line();
    for (auto words = next_line(); words.empty() || words[0] != "end_header"; words = next_line())
        if (!words.empty()) read_statement(words);
    if (!has_format_) throw error("no format is named");
    return std::move(header_);
}

void HeaderReader::read_statement(const std::vector<std::string_view>& words) {
    if (words[0] == "format") return read_format(words);
    if (words[0] == "element") return read_element(words);
    if (words[0] == "property") return read_property(words);
    if (words[0] != "comment" && words[0] != "obj_info")
        throw error("\"" + std::string{words[0].substr(0, 40)} + "\" is no statement");
}

void HeaderReader::read_format(const std::vector<std::string_view>& words) {
    constexpr std::string_view names[] = {"ascii", "binary_little_endian", "binary_big_endian"};
    const auto found = std::find(std::begin(names), std::end(names),
                                 words.size() > 1 ? words[1] : std::string_view{});
    if (found == std::end(names)) throw error("the format is not known");
    header_.encoding = PlyEncoding(found - std::begin(names));
    has_format_ = true;
}

void HeaderReader::read_element(const std::vector<std::string_view>& words) {
    if (words.size() != 3) throw error("an element has a name and a count");
    std::uint64_t count = 0;
    const auto [end, failure] =
        std::from_chars(words[2].data(), words[2].data() + words[2].size(), count);
    if (failure != std::errc{} || end != words[2].data() + words[2].size())
        throw error("the count of an element is not a whole number");
    header_.elements.push_back({std::string{words[1]}, count});
}

void HeaderReader::read_property(const std::vector<std::string_view>& words) {
    const bool list = words.size() == 5 && words[1] == "list";
    if (words.size() != 3 && !list) throw error("a property has a type and a name");
    if (header_.elements.empty()) throw error("a property stands before all elements");
    PlyProperty property{std::string{words.back()}, type(words[words.size() - 2])};
    if (list) {
        property.count_type = type(words[2]);
        if (is_float(*property.count_type)) throw error("the length of a list is a whole number");
    }
    header_.elements.back().properties.push_back(std::move(property));
}

ScalarType HeaderReader::type(std::string_view word) const {
    const auto found = std::find_if(std::begin(type_names), std::end(type_names),
                                    [word](const TypeName& t) { return t.name == word; });
    if (found == std::end(type_names))
        throw error("\"" + std::string{word.substr(0, 40)} + "\" is no type");
    return found->type;
}

}  // namespace

std::optional<std::size_t> PlyElement::find(std::initializer_list<std::string_view> names) const {
    for (const std::string_view name : names)
        for (std::size_t i = 0; i < properties.size(); ++i)
            if (properties[i].name == name) return i;
    return std::nullopt;
}

PlyHeader read_ply_header(std::string_view content, const std::string& name) {
    return HeaderReader{content, name}.read();
}

}  // namespace opacity
