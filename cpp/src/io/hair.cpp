// cyHair files: https://www.cemyuksel.com/research/hairmodels
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <numeric>

#include "core/number_text.hpp"
#include "io/file.hpp"
#include "opacity/io/load.hpp"
#include "opacity/scene/positions.hpp"
#include "opacity/scene/strands.hpp"
#include "scene/check.hpp"

namespace opacity {
namespace {

static_assert(std::endian::native == std::endian::little, ".hair files are little-endian");

constexpr std::uint32_t has_segments = 1, has_points = 2, has_thickness = 4, has_transparency = 8,
                        has_colors = 16, has_known = 31;

struct Header {
    std::array<char, 4> magic;
    std::uint32_t strands, points, arrays, segments;
    float thickness, transparency;
    float3 color;
    std::array<char, 88> information;

    bool has(std::uint32_t array) const { return (arrays & array) != 0; }
};
static_assert(sizeof(Header) == 128);

constexpr const char* repair =
    "the file is damaged or was not written to the end: export or copy it again";

Header read_header(InputFile& file) {
    if (file.size() < sizeof(Header))
        throw file.error(
            "has " + std::to_string(file.size()) + " bytes; a .hair header alone has 128", repair);
    Header header;
    file.read(&header, sizeof header);
    if (std::memcmp(header.magic.data(), "HAIR", 4) != 0)
        throw file.error("does not begin with HAIR",
                         "pass a cyHair file; for another format its suffix");
    if (!header.has(has_points))
        throw file.error("holds no points", "export the hair with its points");
    if (header.arrays & ~has_known)
        throw file.error("announces unknown arrays (bits " + std::to_string(header.arrays) + ")",
                         "export segments, points, thickness, transparency and colours only");
    return header;
}

// Before anything is allocated, so that a header cannot ask for more memory than the file has
// content. In 64 bits four billion points do not overflow.
void check_size(const InputFile& file, const Header& header) {
    const std::uint64_t floats_a_point = 3u + (header.has(has_thickness) ? 1u : 0u) +
                                         (header.has(has_transparency) ? 1u : 0u) +
                                         (header.has(has_colors) ? 3u : 0u);
    const std::uint64_t expected = sizeof(Header) + sizeof(float) * floats_a_point * header.points +
                                   (header.has(has_segments) ? 2ull * header.strands : 0ull);
    if (file.size() == expected) return;
    throw file.error("has " + std::to_string(file.size()) + " bytes; its header (" +
                         std::to_string(header.strands) + " strands, " +
                         std::to_string(header.points) + " points) announces " +
                         std::to_string(expected),
                     repair);
}

template <class T>
std::vector<T> read_array(InputFile& file, std::size_t count) {
    std::vector<T> values(count);
    if (count > 0) file.read(values.data(), count * sizeof(T));
    return values;
}

// Strand k has segments[k] + 1 points; sums are compared before the offsets are allocated.
std::vector<std::int64_t> read_offsets(InputFile& file, const Header& header) {
    std::vector<std::uint16_t> segments;
    std::uint64_t sum = header.strands * std::uint64_t{header.segments};
    if (header.has(has_segments)) {
        segments = read_array<std::uint16_t>(file, header.strands);
        sum = std::accumulate(segments.begin(), segments.end(), std::uint64_t{0});
    }
    if (sum + header.strands != header.points)
        throw file.error("has " + std::to_string(header.strands) + " strands with " +
                             std::to_string(sum) + " segments, so " +
                             std::to_string(sum + header.strands) + " points; its header says " +
                             std::to_string(header.points),
                         repair);
    std::vector<std::int64_t> offsets(std::size_t{header.strands} + 1);
    for (std::size_t k = 0; k < header.strands; ++k)
        offsets[k + 1] = offsets[k] + 1 + (segments.empty() ? header.segments : segments[k]);
    return offsets;
}

void check(const InputFile& file, const char* name, std::span<const float> values,
           const Allowed& allowed, std::size_t width) {
    const std::size_t bad = first_refused(values, allowed);
    if (bad == values.size()) return;
    throw file.error(std::string{"has "} + name + "[" + std::to_string(bad / width) +
                         "] = " + number_text(values[bad]) + ", which is not " + allowed.words,
                     "repair the value where the hair was made, and export again");
}

// The array, or where there is none the header's default for all points.
std::vector<float> read_attribute(InputFile& file, const Header& header, std::uint32_t bit,
                                  const char* name, float default_value, const Allowed& allowed) {
    const bool present = header.has(bit);
    std::vector<float> values =
        present ? read_array<float>(file, header.points) : std::vector<float>{default_value};
    check(file, (present ? "" : std::string{"default "}).append(name).c_str(), values, allowed, 1);
    return values;
}

std::vector<float3> read_colors(InputFile& file, const Header& header) {
    const bool present = header.has(has_colors);
    std::vector<float3> colors =
        present ? read_array<float3>(file, header.points) : std::vector<float3>{header.color};
    check(file, present ? "colour" : "default colour", flat(colors), brightness, 3);
    return colors;
}

}  // namespace

std::vector<ShapePtr> load_hair(const std::filesystem::path& path) {
    InputFile file{path};
    const Header header = read_header(file);
    check_size(file, header);
    std::vector<std::int64_t> offsets = read_offsets(file, header);
    std::vector<float> xyz = read_array<float>(file, 3 * std::size_t{header.points});
    check(file, "point", xyz, {-max_coordinate, max_coordinate, "finite and at most 1e18 in size"},
          3);
    std::vector<float> width =
        read_attribute(file, header, has_thickness, "thickness", header.thickness, not_negative);
    std::vector<float> opacity = read_attribute(file, header, has_transparency, "transparency",
                                                header.transparency, unit_interval);
    for (float& value : opacity) value = 1.f - value;
    std::vector<float3> color = read_colors(file, header);
    return {std::make_shared<Strands>(Positions{std::move(xyz)}, std::move(offsets),
                                      std::move(width), std::move(opacity), std::move(color))};
}

}  // namespace opacity
