#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "io/crc32.hpp"
#include "load_help.hpp"
#include "opacity/scene/volume.hpp"

using namespace opacity;
using doctest::Approx;

namespace {

const std::string header = "NRRD0004\n# a test\ndimension: 3\n";

template <class T>
std::string numbers(const std::vector<T>& values, bool big_endian = false) {
    std::string all;
    for (const T value : values) {
        std::string bytes;
        append(bytes, value);
        if (big_endian) std::reverse(bytes.begin(), bytes.end());
        all += bytes;
    }
    return all;
}

const std::vector<float> densities{0, 1, 2, 3, 4, 5};
const std::string fields = header + "sizes: 3 2 1\ntype: float\nencoding: raw\nendian: little\n";

std::shared_ptr<Volume> volume(const ScratchFolder& folder, const std::string& content) {
    return all<Volume>(load(folder.write("a.nrrd", content).string())).at(0);
}

// One stored block, as deflate allows.
std::string gzip_file(const std::string& content, const std::string& name = {}) {
    std::string file{"\x1F\x8B\x08", 3};
    file.push_back(name.empty() ? '\0' : '\x08');
    file.resize(10);
    if (!name.empty()) file += name + '\0';
    file += '\x01';
    append(file, std::uint16_t(content.size()));
    append(file, std::uint16_t(~content.size()));
    file += content;
    append(file, crc32(std::as_bytes(std::span{content})));
    append(file, std::uint32_t(content.size()));
    return file;
}

}  // namespace

TEST_CASE("an NRRD is a volume, x fastest, in its place") {
    const ScratchFolder folder;
    const auto shape = volume(folder, fields +
                                          "space dimension: 3\n"
                                          "space directions: (.5,0,0) (0, 2, 0) (0,0,+1e1)\n"
                                          "space origin: (1,-2,3)\nkey:=value: x\n\n" +
                                          numbers(densities));
    CHECK(shape->size_zyx() == Volume::Size{1, 2, 3});
    CHECK(shape->extinction() == densities);
    CHECK(shape->spacing() == double3{0.5, 2, 10});
    CHECK(shape->origin() == double3{1, -2, 3});
    CHECK(shape->transform() == identity);
}

TEST_CASE("scalars of every type and order are read") {
    const ScratchFolder folder;
    const auto check = [&](const std::string& name, auto zero) {
        const std::vector<decltype(zero)> values{0, 1, 2, 3, 4, 100};
        for (const bool big : {false, true}) {
            CAPTURE(name);
            const auto shape =
                volume(folder, header + "Sizes: 6 1 1\nTYPE: " + name +
                                   "\nencoding: raw\nendian: " + (big ? "big" : "little") + "\n\n" +
                                   numbers(values, big));
            CHECK(shape->extinction() == std::vector<float>{0, 1, 2, 3, 4, 100});
        }
    };
    check("signed char", std::int8_t{});
    check("uchar", std::uint8_t{});
    check("short", std::int16_t{});
    check("unsigned short", std::uint16_t{});
    check("int32_t", std::int32_t{});
    check("uint", std::uint32_t{});
    check("long long", std::int64_t{});
    check("uint64", std::uint64_t{});
    check("float", float{});
    check("double", double{});
}

TEST_CASE("spacings and axis mins place a volume without directions") {
    const ScratchFolder folder;
    const auto plain = volume(folder, fields + "\n" + numbers(densities));
    CHECK(plain->spacing() == double3{1, 1, 1});
    CHECK(plain->origin() == double3{0, 0, 0});
    const auto placed = volume(
        folder, fields + "spacings: 2 nan 4\naxis mins: 10 nan 30\ncenters: cell ??? node\n\n" +
                    numbers(densities));
    CHECK(placed->spacing() == double3{2, 1, 4});
    CHECK(placed->origin() == double3{11, 0, 30});
}

TEST_CASE("turned, mirrored and slanted axes are a transform of columns of length 1") {
    const ScratchFolder folder;
    const auto shape = volume(folder, fields +
                                          "space directions: (0,2,0) (-3,0,0) (0,3,4)\n"
                                          "space origin: (7,8,9)\n\n" +
                                          numbers(densities));
    CHECK(shape->spacing() == double3{2, 3, 5});
    // The middle of voxel (1, 1, 0), and of a voxel one up.
    CHECK(transform_point(shape->transform(), shape->voxel_center(4)) == double3{4, 10, 9});
    const double3 up = transform_point(shape->transform(), {0, 0, 5});
    CHECK(up[1] == Approx(11));
    CHECK(up[2] == Approx(13));
}

TEST_CASE("gzip is unpacked, and checked") {
    const ScratchFolder folder;
    const std::string gzip =
        header + "sizes: 3 2 1\ntype: float\nencoding: gzip\nendian: little\n\n";
    const std::string packed = gzip_file(numbers(densities));
    CHECK(volume(folder, gzip + packed)->extinction() == densities);
    CHECK(volume(folder, gzip + gzip_file(numbers(densities), "a.raw"))->extinction() == densities);
    check_cuts(folder, "cut.nrrd", gzip + packed);
    std::string flipped = packed;
    flipped[20] ^= 1;
    CHECK(contains(refusal(folder, "a.nrrd", gzip + flipped), "does not unpack"));
    const auto large = gzip.find("3 2 1");
    CHECK(contains(
        refusal(folder, "a.nrrd", std::string{gzip}.replace(large, 5, "2048 2048 2048") + packed),
        "does not unpack"));
}

TEST_CASE("an NRRD cut anywhere, or with bytes too many, is refused") {
    const ScratchFolder folder;
    const std::string whole = fields + "\n" + numbers(densities);
    check_cuts(folder, "cut.nrrd", whole);
    CHECK(contains(refusal(folder, "long.nrrd", whole + "x"), "25 bytes"));
    check_damage(folder, "damaged.nrrd", whole);
    CHECK(volume(folder, fields + "byte skip: -1\n\nbefore" + numbers(densities))->extinction() ==
          densities);
}

TEST_CASE("a voxel that no density can be is named, the first of them") {
    const ScratchFolder folder;
    const auto with = [&](float value) {
        std::vector<float> damaged = densities;
        damaged[4] = value;
        damaged[5] = -9;
        return refusal(folder, "bad.nrrd", fields + "\n" + numbers(damaged));
    };
    CHECK(contains(with(-1), "voxel (1, 1, 0) = -1"));
    CHECK(contains(with(std::numeric_limits<float>::quiet_NaN()), "voxel (1, 1, 0) = nan"));
    CHECK(contains(with(std::numeric_limits<float>::infinity()), "voxel (1, 1, 0) = inf"));
}

TEST_CASE("what an NRRD's header may not say is named") {
    const ScratchFolder folder;
    const auto refused = [&](const std::string& old, const std::string& fresh) {
        std::string text = fields;
        text.replace(text.find(old), old.size(), fresh);
        return refusal(folder, "bad.nrrd", text + "\n" + numbers(densities));
    };
    CHECK(contains(refused("raw", "bzip2"), "bzip2"));
    CHECK(contains(refused("raw", "ascii"), "ascii"));
    CHECK(contains(refused("float", "block"), "block"));
    CHECK(contains(refused("little", "middle"), "endian"));
    CHECK(contains(refused("endian: little\n", ""), "endian"));
    CHECK(contains(refused("dimension: 3", "dimension: 4"), "dimension"));
    CHECK(contains(refused("dimension: 3\n", ""), "dimension"));
    CHECK(contains(refused("3 2 1", "3 2"), "sizes"));
    CHECK(contains(refused("3 2 1", "3 2 0"), "sizes"));
    CHECK(contains(refused("3 2 1", "3 -2 1"), "sizes"));
    CHECK(contains(refused("3 2 1", "3 2.5 1"), "sizes"));
    CHECK(contains(refused("3 2 1", "99999999999 2 1"), "sizes"));
    CHECK(contains(refused("3 2 1", "2048 2048 2048"), "announces"));
    CHECK(contains(refused("NRRD0004", "NRD"), "NRRD000"));
    CHECK(contains(refused("sizes:", "nonsense\nsizes:"), "bad.nrrd:4"));
    const auto also = [&](const std::string& line) {
        return refusal(folder, "bad.nrrd", fields + line + "\n\n" + numbers(densities));
    };
    CHECK(contains(also("data file: /etc/passwd"), "datafile"));
    CHECK(contains(also("line skip: 1"), "lineskip"));
    CHECK(contains(also("byte skip: 5"), "byteskip"));
    CHECK(contains(also("spacings: 1 1 0"), "span no volume"));
    CHECK(contains(also("spacings: 1 1 inf"), "spacings"));
    CHECK(contains(also("spacings: 1 x 1"), "spacings"));
    CHECK(contains(also("space directions: (1,0,0) (1,0,0) (0,0,1)"), "span no volume"));
    CHECK(contains(also("space directions: (1,0,0) (0,1,0)"), "spacedirections"));
    CHECK(contains(also("space directions: (1,0) (0,1) (1,1)"), "spacedirections"));
    CHECK(contains(also("space directions: (1,0,0) (0,nan,0) (0,0,1)"), "spacedirections"));
    CHECK(contains(also("space directions: none (0,1,0) (0,0,1)"), "spacedirections"));
    CHECK(contains(also("space directions: (1,0,0) (0,1,0) (0,0,1)\nspace origin: 0 0 0"),
                   "spaceorigin"));
}
