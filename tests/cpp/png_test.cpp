#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <sstream>

#define STBI_ONLY_PNG
#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#if defined(__GNUC__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wshadow"
#endif
#include <stb/stb_image.h>
#if defined(__GNUC__)
#pragma GCC diagnostic pop
#endif

#include "opacity/core/error.hpp"
#include "opacity/io/load.hpp"
#include "scratch_folder.hpp"

using namespace opacity;

namespace {

struct Decoded {
    int width = 0, height = 0;
    std::vector<unsigned char> rgba;
};

Decoded decode(const std::filesystem::path& path) {
    Decoded result;
    int channels = 0;
    const std::unique_ptr<unsigned char, void (*)(void*)> pixels{
        stbi_load(path.string().c_str(), &result.width, &result.height, &channels, 4),
        stbi_image_free};
    REQUIRE(pixels);
    CHECK(channels == 4);
    result.rgba.assign(pixels.get(), pixels.get() + 4 * result.width * result.height);
    return result;
}

// IEC 61966-2-1, in float64.
int srgb8(double linear) {
    const double c =
        linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
    return int(std::floor(255.0 * c + 0.5));
}

std::string content(const std::filesystem::path& path) {
    std::ostringstream text;
    text << std::ifstream{path, std::ios::binary}.rdbuf();
    return text.str();
}

Image pixel(float r, float g, float b, float a) {
    return {1, 1, {r, g, b, a}};
}

}  // namespace

TEST_CASE("a saved picture is the sRGB curve of what was given, rows from the top") {
    const ScratchFolder folder;
    Image image{64, 33, {}};
    for (int i = 0; i < image.width * image.height; ++i) {
        const float value = float(i) / float(image.width * image.height - 1);
        image.rgba.insert(image.rgba.end(), {value, value * value, 1.f - value, 1.f});
    }
    save_png(folder.file("ramp.png"), image);
    const Decoded decoded = decode(folder.file("ramp.png"));
    REQUIRE(decoded.width == image.width);
    REQUIRE(decoded.height == image.height);
    int worst = 0;
    for (std::size_t i = 0; i < image.rgba.size(); ++i) {
        const int right = i % 4 == 3 ? 255 : srgb8(image.rgba[i]);
        // A value on the edge between two bytes may round either way in float32.
        worst = std::max(worst, std::abs(right - int(decoded.rgba[i])));
        if (std::abs(right - int(decoded.rgba[i])) == 1)
            CHECK(srgb8(image.rgba[i] + 1e-6) != srgb8(image.rgba[i] - 1e-6));
    }
    CHECK(worst <= 1);
}

TEST_CASE("premultiplied colour becomes straight") {
    const ScratchFolder folder;
    save_png(folder.file("a.png"), pixel(0.1f, 0.2f, 0.4f, 0.4f));
    const Decoded decoded = decode(folder.file("a.png"));
    const std::vector<unsigned char> right{(unsigned char)srgb8(0.25), (unsigned char)srgb8(0.5),
                                           255, 102};
    CHECK(decoded.rgba == right);
}

TEST_CASE("no value breaks a picture") {
    const ScratchFolder folder;
    const float not_a_number = std::numeric_limits<float>::quiet_NaN(),
                inf = std::numeric_limits<float>::infinity();
    const auto saved = [&](Image image) {
        save_png(folder.file("x.PNG"), image);
        return decode(folder.file("x.PNG")).rgba;
    };
    CHECK(saved(pixel(not_a_number, inf, -inf, 1)) == std::vector<unsigned char>{0, 255, 0, 255});
    CHECK(saved(pixel(1, 1, 1, not_a_number)) == std::vector<unsigned char>{0, 0, 0, 0});
    CHECK(saved(pixel(1, 0, 0, 0)) == std::vector<unsigned char>{0, 0, 0, 0});
    CHECK(saved(pixel(7, -1, 0.5f, 2)) ==
          std::vector<unsigned char>{255, 0, (unsigned char)srgb8(0.5), 255});
}

TEST_CASE("saving replaces the old file and leaves nothing beside it") {
    const ScratchFolder folder;
    save_png(folder.file("a.png"), pixel(0, 0, 0, 1));
    save_png(folder.file("a.png"), pixel(1, 1, 1, 1));
    CHECK(decode(folder.file("a.png")).rgba[0] == 255);
    CHECK(folder.entries() == 1);
}

TEST_CASE("a save that fails says why and touches nothing") {
    const ScratchFolder folder;
    const auto old = folder.write("old.png", "precious");
    const auto refusal = [](const std::filesystem::path& path, const Image& image) {
        return message_of<ParameterError>([&] { save_png(path, image); });
    };
    const Image one = pixel(1, 1, 1, 1);
    CHECK(contains(refusal(folder.file("missing/a.png"), one), "folder"));
    CHECK(contains(refusal(folder.file("a.jpg"), one), ".png"));
    CHECK(contains(refusal(folder.file("a"), one), ".png"));
    CHECK(contains(refusal(old, Image{}), "0 x 0"));
    CHECK(contains(refusal(old, Image{-1, 1, {}}), "-1 x 1"));
    CHECK(contains(refusal(old, Image{2, 1, {0, 0, 0, 0}}), "4 numbers"));
    // A folder of that name stands in the way of the last step, the rename.
    std::filesystem::create_directories(folder.file("folder.png/inside"));
    CHECK(!refusal(folder.file("folder.png"), one).empty());
    CHECK(content(old) == "precious");
    CHECK(folder.entries() == 2);
}
