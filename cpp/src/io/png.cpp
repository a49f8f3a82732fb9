#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <random>
#include <string>

#include "io/file.hpp"
#include "io/srgb.hpp"
#include "io/stb_writer.hpp"
#include "opacity/core/error.hpp"
#include "opacity/io/load.hpp"

namespace opacity {
namespace {

namespace fs = std::filesystem;

// NaN becomes 0: the comparison is false for it.
float clamp01(float value) {
    return value > 0.f ? std::min(value, 1.f) : 0.f;
}

std::uint8_t byte(float value) {
    return static_cast<std::uint8_t>(std::lround(255.f * clamp01(value)));
}

std::vector<std::uint8_t> straight_srgb(const Image& image) {
    std::vector<std::uint8_t> bytes(image.rgba.size());
    for (std::size_t i = 0; i < bytes.size(); i += 4) {
        const float alpha = clamp01(image.rgba[i + 3]);
        for (std::size_t c = 0; c < 3; ++c)
            bytes[i + c] =
                alpha > 0.f ? byte(srgb_from_linear(clamp01(image.rgba[i + c] / alpha))) : 0;
        bytes[i + 3] = byte(alpha);
    }
    return bytes;
}

void check_image(const Image& image) {
    constexpr std::size_t max_pixels = std::size_t{1} << 27;  // stb counts its bytes in an int
    const std::string size = std::to_string(image.width) + " x " + std::to_string(image.height);
    if (image.width <= 0 || image.height <= 0)
        throw ParameterError("the image is " + size + " pixels",
                             "save an image of one pixel or more");
    const std::size_t pixels = std::size_t(image.width) * std::size_t(image.height);
    if (image.rgba.size() != 4 * pixels)
        throw ParameterError("an image of " + size + " pixels holds " +
                                 std::to_string(image.rgba.size()) + " numbers",
                             "give four a pixel: " + std::to_string(4 * pixels));
    if (pixels > max_pixels)
        throw ParameterError(
            "an image of " + size + " pixels is too large for one PNG",
            "save it in tiles of at most " + std::to_string(max_pixels) + " pixels");
}

// Beside the target, so that the rename stays on one file system; removed unless it becomes the
// target.
class PartialFile {
   public:
    explicit PartialFile(const fs::path& target) : target_{target}, path_{target} {
        std::random_device random;
        path_ += std::string{"."}.append(std::to_string(random())).append(".part");
        // "x" fails rather than write over what somebody else put there.
        file_.reset(std::fopen(path_.string().c_str(), "wbx"));
        if (!file_) fail("its folder is missing or not writable");
    }
    PartialFile(const PartialFile&) = delete;
    PartialFile& operator=(const PartialFile&) = delete;
    ~PartialFile() { discard(); }

    void write(const void* bytes, std::size_t count) {
        if (std::fwrite(bytes, 1, count, file_.get()) != count) fail("the disk is full or failed");
    }
    void become_target() {
        // What a disk refuses may only show when the file is closed.
        if (std::fclose(file_.release()) != 0) fail("the disk is full or failed");
        std::error_code failure;
        fs::rename(path_, target_, failure);
        if (failure) fail(failure.message());
        path_.clear();
    }

   private:
    [[noreturn]] void fail(const std::string& reason) {
        discard();
        throw ParameterError(
            target_.string() + " cannot be written: " + reason,
            "choose a file in a folder that exists and has room, and where you may write");
    }
    void discard() noexcept {
        const bool made = file_ != nullptr || !path_.empty();
        file_.reset();
        std::error_code ignored;
        if (made) fs::remove(path_, ignored);
    }

    struct Close {
        void operator()(std::FILE* file) const { std::fclose(file); }
    };
    fs::path target_, path_;
    std::unique_ptr<std::FILE, Close> file_;
};

}  // namespace

void save_png(const fs::path& path, const Image& image) {
    if (lower_suffix(path) != ".png")
        throw ParameterError(path.string() + " is not the name of a PNG", "end the name in .png");
    check_image(image);
    const std::vector<std::uint8_t> bytes = straight_srgb(image);
    int size = 0;
    const std::unique_ptr<unsigned char, decltype(&std::free)> png{
        stbi_write_png_to_mem(bytes.data(), 4 * image.width, image.width, image.height, 4, &size),
        &std::free};
    if (!png)
        throw OutOfMemoryError("no memory is left to compress " + path.string(),
                               "save a smaller image");
    PartialFile file{path};
    file.write(png.get(), static_cast<std::size_t>(size));
    file.become_target();
}

}  // namespace opacity
