#include "core/number_text.hpp"
#include "core/vector.hpp"
#include "io/file.hpp"
#include "io/gzip.hpp"
#include "io/nrrd_header.hpp"
#include "opacity/io/load.hpp"
#include "opacity/scene/volume.hpp"
#include "scene/check.hpp"

namespace opacity {
namespace {

constexpr const char* copy_again =
    "the file is damaged or was not written to the end: export or copy it again";

// The voxels' bytes, as they stand in the content or in `unpacked`; checked against the sizes
// before anything is allocated.
Bytes voxel_bytes(std::string_view content, const NrrdHeader& header, const std::string& name,
                  std::vector<std::byte>& unpacked) {
    const Bytes behind = std::as_bytes(std::span{content}.subspan(header.size));
    const auto& [x, y, z] = header.sizes;
    const std::uint64_t announced = x * y * z * size_of(header.type);
    if (header.encoding == NrrdEncoding::gzip) {
        if (auto bytes = gunzipped(behind, announced)) return unpacked = std::move(*bytes);
        throw FileFormatError(name + " does not unpack to the " + std::to_string(announced) +
                                  " bytes that its header announces",
                              copy_again);
    }
    const bool fits = header.from_the_end ? behind.size() >= announced : behind.size() == announced;
    if (!fits)
        throw FileFormatError(name + " has " + std::to_string(behind.size()) +
                                  " bytes of voxels; its header announces " +
                                  std::to_string(announced),
                              copy_again);
    return behind.last(std::size_t(announced));
}

std::vector<float> voxels(Bytes bytes, const NrrdHeader& header, const std::string& name) {
    constexpr Allowed extinction{0.0, 1e18, "in 0..1e18"};
    const std::size_t size = size_of(header.type);
    std::vector<float> values(bytes.size() / size);
    for (std::size_t i = 0; i < values.size(); ++i) {
        const double value = scalar_at(&bytes[i * size], header.type, header.order);
        values[i] = float(value);
        if (extinction(value)) continue;
        const std::size_t nx = std::size_t(header.sizes[0]), ny = std::size_t(header.sizes[1]);
        throw FileFormatError(name + " has voxel (" + std::to_string(i % nx) + ", " +
                                  std::to_string(i / nx % ny) + ", " + std::to_string(i / nx / ny) +
                                  ") = " + number_text(value) + ", which is not " +
                                  extinction.words,
                              "repair the value where the volume was made, and save it again");
    }
    return values;
}

bool is_along_axes(const std::array<double3, 3>& directions) {
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t k = 0; k < 3; ++k)
            if (i == k ? !(directions[i][k] > 0.0) : directions[i][k] != 0.0) return false;
    return true;
}

// Directions that are turned, mirrored or slanted go to the transform, of columns of length 1, so
// that the spacing stays one of the world.
std::shared_ptr<Volume> volume(const NrrdHeader& header, std::vector<float> extinction) {
    const auto& [x, y, z] = header.sizes;
    const Volume::Size size_zyx{int(z), int(y), int(x)};
    const auto& d = header.directions;
    const double3 spacing{length(d[0]), length(d[1]), length(d[2])};
    if (is_along_axes(d))
        return std::make_shared<Volume>(size_zyx, std::move(extinction), header.origin, spacing);
    auto shape = std::make_shared<Volume>(size_zyx, std::move(extinction), double3{}, spacing);
    double4x4 transform = identity;
    for (std::size_t row = 0; row < 3; ++row) {
        for (std::size_t axis = 0; axis < 3; ++axis)
            transform[4 * row + axis] = d[axis][row] / spacing[axis];
        transform[4 * row + 3] = header.origin[row];
    }
    shape->set_transform(transform);
    return shape;
}

}  // namespace

std::vector<ShapePtr> load_nrrd(const std::filesystem::path& path) {
    const std::string name = path.string(), content = read_text(path);
    const NrrdHeader header = read_nrrd_header(content, name);
    std::vector<std::byte> unpacked;
    std::vector<float> extinction =
        voxels(voxel_bytes(content, header, name, unpacked), header, name);
    try {
        return {volume(header, std::move(extinction))};
    } catch (const ParameterError& error) {  // axes without extent, or all in one plane
        throw FileFormatError(name + " has axes that span no volume: " + error.problem(),
                              "write the directions of three different axes");
    }
}

}  // namespace opacity
