#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "load_help.hpp"
#include "opacity/scene/strands.hpp"

using namespace opacity;
using doctest::Approx;

namespace {

constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();

// A .hair file written field by field; each may lie.
struct HairFile {
    std::string magic = "HAIR";
    std::uint32_t strands = 2, points = 5, arrays = 31, default_segments = 9;
    float thickness = 0.2f, transparency = 0.25f;
    float3 color{0.1f, 0.2f, 0.3f};
    std::vector<std::uint16_t> segments{1, 2};
    std::vector<float> xyz{0, 0, 0, 1, 0, 0, 5, 0, 0, 6, 0, 0, 7, 0, 0};
    std::vector<float> widths{0.1f, 0.2f, 0.3f, 0.4f, 0.5f};
    std::vector<float> transparencies{0, 0.25f, 0.5f, 0.75f, 1};
    std::vector<float> colors = std::vector<float>(15, 0.5f);

    std::string bytes() const {
        std::string result = magic;
        for (const std::uint32_t field : {strands, points, arrays, default_segments})
            append(result, field);
        append(result, thickness);
        append(result, transparency);
        append(result, color);
        result.resize(128);
        if (arrays & 1)
            for (const std::uint16_t s : segments) append(result, s);
        if (arrays & 2) append_all(result, xyz);
        if (arrays & 4) append_all(result, widths);
        if (arrays & 8) append_all(result, transparencies);
        if (arrays & 16) append_all(result, colors);
        return result;
    }
    static void append_all(std::string& bytes, const std::vector<float>& values) {
        for (const float value : values) append(bytes, value);
    }
};

std::shared_ptr<Strands> strands_of(const std::vector<ShapePtr>& shapes) {
    REQUIRE(!shapes.empty());
    auto strands = std::dynamic_pointer_cast<Strands>(shapes[0]);
    REQUIRE(strands);
    return strands;
}

}  // namespace

TEST_CASE("a .hair file with every array") {
    const ScratchFolder folder;
    const auto hair = strands_of(load(folder.write("a.hair", HairFile{}.bytes()).string()));
    CHECK(hair->offsets() == std::vector<std::int64_t>{0, 2, 5});
    CHECK(hair->points()[2] == double3{5, 0, 0});
    CHECK(hair->width() == std::vector<float>{0.1f, 0.2f, 0.3f, 0.4f, 0.5f});
    CHECK(hair->opacity() == std::vector<float>{1, 0.75f, 0.5f, 0.25f, 0});
    CHECK(hair->color() == std::vector<float3>(5, float3{0.5f, 0.5f, 0.5f}));
}

TEST_CASE("a .hair file of points only takes the header's defaults") {
    const ScratchFolder folder;
    HairFile file;
    file.arrays = 2, file.strands = 1, file.default_segments = 4;
    const auto hair = strands_of(load(folder.write("a.HAIR", file.bytes()).string()));
    CHECK(hair->offsets() == std::vector<std::int64_t>{0, 5});
    CHECK(hair->width() == std::vector<float>{0.2f});
    CHECK(hair->opacity() == std::vector<float>{0.75f});
    CHECK(hair->color() == std::vector<float3>{{0.1f, 0.2f, 0.3f}});
}

TEST_CASE("every combination of arrays is read in its place") {
    const ScratchFolder folder;
    for (std::uint32_t arrays = 2; arrays < 32; ++arrays) {
        if (!(arrays & 2)) continue;
        HairFile file;
        file.arrays = arrays;
        if (!(arrays & 1)) file.strands = 1, file.default_segments = 4;
        const auto hair = strands_of(load(folder.write("a.hair", file.bytes()).string()));
        CHECK(hair->points()[4] == double3{7, 0, 0});
        CHECK(hair->width().size() == (arrays & 4 ? 5 : 1));
        CHECK(hair->opacity().back() == (arrays & 8 ? 0.f : 0.75f));
        CHECK(hair->color()[0][0] == (arrays & 16 ? 0.5f : 0.1f));
    }
}

TEST_CASE("a .hair file cut anywhere, or with bytes too many, is refused with both sizes") {
    const ScratchFolder folder;
    const std::string whole = HairFile{}.bytes();
    for (std::size_t size = 0; size < whole.size(); ++size) {
        const std::string message = refusal(folder, "cut.hair", whole.substr(0, size));
        CHECK(contains(message, "cut.hair"));
        CHECK(contains(message, std::to_string(size)));
    }
    const std::string message = refusal(folder, "long.hair", whole + "x");
    CHECK(contains(message, std::to_string(whole.size() + 1)));
    CHECK(contains(message, std::to_string(whole.size())));
}

TEST_CASE("a .hair header that lies is refused before it costs memory") {
    const ScratchFolder folder;
    const auto with = [&](auto change) {
        HairFile file;
        change(file);
        return refusal(folder, "lie.hair", file.bytes());
    };
    const std::uint32_t billions = 0xFFFF'FFFF;
    CHECK(contains(with([&](HairFile& f) { f.points = billions; }), "announces 137438"));
    CHECK(contains(with([&](HairFile& f) { f.strands = billions; }), "announces"));
    CHECK(contains(with([&](HairFile& f) { f.segments = {1, 3}; }), "6 points"));
    CHECK(contains(with([&](HairFile& f) { f.magic = "HARE"; }), "HAIR"));
    CHECK(contains(with([&](HairFile& f) { f.arrays = 29; }), "no points"));
    CHECK(contains(with([&](HairFile& f) { f.arrays = 63; }), "unknown"));
    CHECK(!with([&](HairFile& f) { f.arrays = 2, f.default_segments = billions; }).empty());
    CHECK(!with([&](HairFile& f) {
               f.arrays = 2, f.default_segments = f.strands = billions;
           }).empty());
}

TEST_CASE("a bad number in a .hair file is named by array and index") {
    const ScratchFolder folder;
    const auto with = [&](auto change) {
        HairFile file;
        change(file);
        return refusal(folder, "bad.hair", file.bytes());
    };
    CHECK(contains(with([](HairFile& f) { f.xyz[3 * 4] = not_a_number; }), "point[4]"));
    CHECK(contains(with([](HairFile& f) { f.widths[2] = -1; }), "thickness[2]"));
    CHECK(contains(with([](HairFile& f) { f.transparencies[1] = 1.5f; }), "transparency[1] = 1.5"));
    CHECK(contains(with([](HairFile& f) { f.colors[5] = not_a_number; }), "colour[1]"));
    CHECK(contains(with([](HairFile& f) { f.arrays = 27, f.thickness = not_a_number; }),
                   "default thickness"));
    // A default that an array stands in for is not read.
    CHECK(with([](HairFile& f) { f.thickness = not_a_number; }).empty());
}

TEST_CASE("a damaged .hair file loads or is refused") {
    check_damage(ScratchFolder{}, "m.hair", HairFile{}.bytes());
}

TEST_CASE("real hair is what its index says") {
    const auto path = real_file("hair/straight.hair");
    if (path.empty()) return;
    const auto hair = strands_of(load(path.string()));
    CHECK(hair->strand_count() == 10'000);
    CHECK(hair->segments().size() == 150'000);
    CHECK(hair->width() == std::vector{0.1f});
    CHECK(hair->opacity()[0] == Approx(1.0 - 0.3558).epsilon(1e-3));
    CHECK(hair->color().size() == hair->points().size());
    // Roots lie on a head, which the index gives as the sphere that fits it best.
    double mean_radius = 0.0;
    for (std::size_t strand = 0; strand < hair->strand_count(); ++strand) {
        const double3 root = hair->points()[std::size_t(hair->offsets()[strand])];
        mean_radius += std::hypot(root[0] + 0.06, root[1] + 0.23, root[2] - 38.63);
    }
    mean_radius /= double(hair->strand_count());
    CHECK(mean_radius == Approx(20.45).epsilon(0.005));
}
