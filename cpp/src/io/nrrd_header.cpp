#include "io/nrrd_header.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "io/parsed_number.hpp"
#include "opacity/core/error.hpp"
#include "opacity/scene/positions.hpp"

namespace opacity {
namespace {

struct TypeName {
    std::string_view name;
    ScalarType type;
};
constexpr TypeName type_names[] = {{"signed char", ScalarType::int8},
                                   {"int8", ScalarType::int8},
                                   {"int8_t", ScalarType::int8},
                                   {"uchar", ScalarType::uint8},
                                   {"unsigned char", ScalarType::uint8},
                                   {"uint8", ScalarType::uint8},
                                   {"uint8_t", ScalarType::uint8},
                                   {"short", ScalarType::int16},
                                   {"short int", ScalarType::int16},
                                   {"signed short", ScalarType::int16},
                                   {"signed short int", ScalarType::int16},
                                   {"int16", ScalarType::int16},
                                   {"int16_t", ScalarType::int16},
                                   {"ushort", ScalarType::uint16},
                                   {"unsigned short", ScalarType::uint16},
                                   {"unsigned short int", ScalarType::uint16},
                                   {"uint16", ScalarType::uint16},
                                   {"uint16_t", ScalarType::uint16},
                                   {"int", ScalarType::int32},
                                   {"signed int", ScalarType::int32},
                                   {"int32", ScalarType::int32},
                                   {"int32_t", ScalarType::int32},
                                   {"uint", ScalarType::uint32},
                                   {"unsigned int", ScalarType::uint32},
                                   {"uint32", ScalarType::uint32},
                                   {"uint32_t", ScalarType::uint32},
                                   {"longlong", ScalarType::int64},
                                   {"long long", ScalarType::int64},
                                   {"long long int", ScalarType::int64},
                                   {"signed long long", ScalarType::int64},
                                   {"signed long long int", ScalarType::int64},
                                   {"int64", ScalarType::int64},
                                   {"int64_t", ScalarType::int64},
                                   {"ulonglong", ScalarType::uint64},
                                   {"unsigned long long", ScalarType::uint64},
                                   {"unsigned long long int", ScalarType::uint64},
                                   {"uint64", ScalarType::uint64},
                                   {"uint64_t", ScalarType::uint64},
                                   {"float", ScalarType::float32},
                                   {"double", ScalarType::float64}};

constexpr std::string_view blanks = " \t\r";

std::string_view trimmed(std::string_view text) {
    const std::size_t begin = text.find_first_not_of(blanks);
    if (begin == text.npos) return {};
    return text.substr(begin, text.find_last_not_of(blanks) - begin + 1);
}

// A field is found whatever its case, and "byteskip" is "byte skip".
std::string key_of(std::string_view name) {
    std::string key;
    for (const char c : name)
        if (c != ' ') key.push_back(c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c);
    if (key == "centers") return "centerings";
    return key;
}

// The fields as they stand, then one after another what they mean.
class HeaderReader {
   public:
    HeaderReader(std::string_view content, const std::string& name)
        : content_{content}, name_{name} {}

    NrrdHeader read();

   private:
    void read_fields();
    void refuse_what_is_not_read() const;
    void read_type();
    void read_encoding();
    void read_sizes();
    void read_directions();
    void read_spacings();
    std::string_view field(const std::string& key) const;
    std::vector<double> numbers(const std::string& key, std::string_view text) const;
    double3 coordinates(const std::string& key, std::string_view text) const;
    FileFormatError error(const std::string& key, const std::string& problem,
                          const std::string& fix) const;

    std::string_view content_;
    const std::string& name_;
    std::map<std::string, std::string_view> fields_;
    NrrdHeader header_;
};

FileFormatError HeaderReader::error(const std::string& key, const std::string& problem,
                                    const std::string& fix) const {
    return {name_ + ": \"" + key + ": " + std::string{field(key).substr(0, 80)} + "\" " + problem,
            fix};
}

std::string_view HeaderReader::field(const std::string& key) const {
    const auto found = fields_.find(key);
    return found == fields_.end() ? std::string_view{} : found->second;
}

NrrdHeader HeaderReader::read() {
    read_fields();
    refuse_what_is_not_read();
    read_type();
    read_encoding();
    read_sizes();
    if (!field("spacedirections").empty())
        read_directions();
    else
        read_spacings();
    return header_;
}

// "field: what it is" a line, "key:=value" for others' use, up to the first empty line.
void HeaderReader::read_fields() {
    for (std::size_t line_number = 1;; ++line_number) {
        const std::size_t end = content_.find('\n', header_.size);
        if (end == content_.npos)
            throw FileFormatError(name_ + " ends within its header",
                                  "copy the file again, or attach the data to its header");
        const std::string_view line = trimmed(content_.substr(header_.size, end - header_.size));
        header_.size = end + 1;
        if (line_number == 1 && !line.starts_with("NRRD000"))
            throw FileFormatError(name_ + " does not begin with NRRD000",
                                  "pass an NRRD file; for another format its suffix");
        if (line_number > 1 && line.empty()) return;
        const std::size_t colon = line.find(':');
        if (line_number == 1 || line[0] == '#' || line.substr(0, colon + 2).ends_with(":="))
            continue;
        if (colon == line.npos)
            throw FileFormatError(name_ + ":" + std::to_string(line_number) + " is no field",
                                  "write \"field: what it is\"");
        fields_[key_of(line.substr(0, colon))] = trimmed(line.substr(colon + 1));
    }
}

void HeaderReader::refuse_what_is_not_read() const {
    if (!field("datafile").empty())
        throw error("datafile", "is another file",
                    "attach the data to its header: unu save -f nrrd");
    if (const std::string_view lines = field("lineskip"); !lines.empty() && lines != "0")
        throw error("lineskip", "is not read", "save the data right behind its header");
    if (const std::string_view dimension = field("dimension"); dimension != "3")
        throw error("dimension", "is not 3", "save one value a voxel, along three axes");
}

void HeaderReader::read_type() {
    const auto found = std::find_if(std::begin(type_names), std::end(type_names),
                                    [&](const TypeName& t) { return t.name == field("type"); });
    if (found == std::end(type_names))
        throw error("type", "is not read", "save the voxels as float");
    header_.type = found->type;
    const std::string_view order = field("endian");
    if (order == "big")
        header_.order = std::endian::big;
    else if (order != "little" && size_of(header_.type) > 1)
        throw error("endian", "is neither little nor big", "say which the voxels are");
}

void HeaderReader::read_encoding() {
    const std::string_view encoding = field("encoding"), skip = field("byteskip");
    const bool gzip = encoding == "gzip" || encoding == "gz";
    if (encoding != "raw" && !gzip)
        throw error("encoding", "is not read", "save the voxels as raw or gzip");
    header_.encoding = gzip ? NrrdEncoding::gzip : NrrdEncoding::raw;
    header_.from_the_end = skip == "-1" && !gzip;
    if (!skip.empty() && skip != "0" && !header_.from_the_end)
        throw error("byteskip", "is not read", "save the data right behind its header");
}

void HeaderReader::read_sizes() {
    const std::vector<double> sizes = numbers("sizes", field("sizes"));
    constexpr double most = 2048;  // what a Volume takes
    const auto is_size = [](double n) { return n >= 1 && n <= most && n == std::floor(n); };
    if (sizes.size() != 3 || !std::all_of(sizes.begin(), sizes.end(), is_size))
        throw error("sizes", "is not three numbers of voxels in 1..2048",
                    "split a larger volume into several");
    for (std::size_t i = 0; i < 3; ++i) header_.sizes[i] = std::uint64_t(sizes[i]);
}

// Parted by blanks; "nan" stands for what is not known.
std::vector<double> HeaderReader::numbers(const std::string& key, std::string_view text) const {
    std::vector<double> result;
    for (text = trimmed(text); !text.empty(); text = trimmed(text)) {
        const std::string_view word = text.substr(0, text.find_first_of(blanks));
        const std::optional<double> value = parsed_number(word);
        if (!value)
            throw error(key, "is no list of numbers", "write numbers with blanks between them");
        result.push_back(*value);
        text.remove_prefix(word.size());
    }
    return result;
}

// "(x, y, z)"
double3 HeaderReader::coordinates(const std::string& key, std::string_view text) const {
    std::string plain{text};
    std::replace(plain.begin(), plain.end(), ',', ' ');
    const std::vector<double> values = numbers(key, plain);
    const auto is_coordinate = [](double x) { return std::abs(x) <= max_coordinate; };
    if (values.size() != 3 || !std::all_of(values.begin(), values.end(), is_coordinate))
        throw error(key, "is not of three finite numbers",
                    "write (x,y,z) in a space of 3 dimensions");
    return {values[0], values[1], values[2]};
}

void HeaderReader::read_directions() {
    std::string_view text = field("spacedirections");
    for (double3& direction : header_.directions) {
        const std::size_t open = text.find('('), close = text.find(')');
        if (open == text.npos || close == text.npos || close < open)
            throw error("spacedirections", "is not three vectors", "write (x,y,z) for each axis");
        direction = coordinates("spacedirections", text.substr(open + 1, close - open - 1));
        text.remove_prefix(close + 1);
    }
    std::string_view origin = field("spaceorigin");
    if (origin.empty()) return;
    if (!origin.starts_with('(') || !origin.ends_with(')'))
        throw error("spaceorigin", "is not a vector", "write (x,y,z)");
    header_.origin = coordinates("spaceorigin", origin.substr(1, origin.size() - 2));
}

// Where an axis begins is the middle of its first voxel, or with centring "cell" its near side.
void HeaderReader::read_spacings() {
    std::vector<double> spacings = numbers("spacings", field("spacings"));
    std::vector<double> begins = numbers("axismins", field("axismins"));
    spacings.resize(3, 1.0);
    begins.resize(3, 0.0);
    std::string_view centerings = field("centerings");
    for (std::size_t i = 0; i < 3; ++i) {
        centerings = trimmed(centerings);
        const std::string_view centering = centerings.substr(0, centerings.find_first_of(blanks));
        centerings.remove_prefix(centering.size());
        const double spacing = std::isnan(spacings[i]) ? 1.0 : spacings[i];
        if (!(std::abs(spacing) <= max_coordinate) || std::abs(begins[i]) > max_coordinate)
            throw error("spacings", "is not finite", "write three finite numbers");
        header_.directions[i][i] = spacing;
        if (!std::isnan(begins[i]))
            header_.origin[i] = begins[i] + (centering == "cell" ? 0.5 * spacing : 0.0);
    }
}

}  // namespace

NrrdHeader read_nrrd_header(std::string_view content, const std::string& name) {
    return HeaderReader{content, name}.read();
}

}  // namespace opacity
