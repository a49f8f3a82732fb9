#include "io/stb_decode.hpp"

#include <array>
#include <climits>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <memory>

#include "opacity/core/error.hpp"

// The one place where stb's reader is compiled; static, so that it cannot meet another copy of
// itself. Of its formats only the two that models use: what is not compiled cannot be attacked.
#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#define STBI_NO_STDIO
#define STBI_NO_LINEAR
#if defined(__GNUC__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wsign-compare"
#endif
#include <stb/stb_image.h>
#if defined(__GNUC__)
#pragma GCC diagnostic pop
#endif

namespace opacity {
namespace {

constexpr std::array<std::uint8_t, 8> png_signature{137, 'P', 'N', 'G', 13, 10, 26, 10};
constexpr std::array<std::uint8_t, 2> jpeg_signature{0xFF, 0xD8};

template <std::size_t n>
bool begins_with(Bytes bytes, const std::array<std::uint8_t, n>& signature) {
    return bytes.size() >= n && std::memcmp(bytes.data(), signature.data(), n) == 0;
}

std::size_t big_endian(Bytes bytes, std::size_t at, std::size_t count) {
    std::size_t value = 0;
    for (std::size_t i = 0; i < count; ++i) value = value << 8 | std::size_t(bytes[at + i]);
    return value;
}

// Whether the chunks reach IEND, and all of it is there: stb does not look at what ends a file.
bool is_whole_png(Bytes bytes) {
    constexpr std::size_t frame = 12;  // length, type and checksum
    std::size_t at = png_signature.size();
    while (bytes.size() - at >= frame) {
        const std::size_t length = big_endian(bytes, at, 4);
        if (length > bytes.size() - at - frame) return false;
        if (std::memcmp(&bytes[at + 4], "IEND", 4) == 0) return true;
        at += frame + length;
    }
    return false;
}

// Whether the tables of a segment of Huffman codes fill it, none with more codes than any picture
// needs: some versions of stb write such a table beyond its array.
bool is_sound_huffman_segment(Bytes segment) {
    constexpr std::size_t head = 17,
                          most_codes = 255;  // what it is for, then how many of 1..16 bits
    while (segment.size() >= head) {
        std::size_t codes = 0;
        for (std::size_t i = 1; i < head; ++i) codes += std::size_t(segment[i]);
        if (codes > most_codes || head + codes > segment.size()) return false;
        segment = segment.subspan(head + codes);
    }
    return segment.empty();
}

// Whether the markers reach the end of the image: stb shows the rest of a cut JPEG as grey. Within
// coded data, 0xFF is followed by 0 or is a restart; other markers are followed by their length.
bool is_whole_jpeg(Bytes bytes) {
    std::size_t at = jpeg_signature.size();
    while (at + 1 < bytes.size()) {
        const auto marker = std::uint8_t(bytes[at + 1]);
        const bool is_restart = marker >= 0xD0 && marker <= 0xD7;
        if (std::uint8_t(bytes[at]) != 0xFF || marker == 0xFF) {
            ++at;
        } else if (marker == 0xD9) {
            return true;
        } else if (marker == 0 || is_restart) {
            at += 2;
        } else {
            if (at + 4 > bytes.size()) return false;
            const std::size_t length = big_endian(bytes, at + 2, 2);
            if (length < 2 || length > bytes.size() - at - 2) return false;
            const bool sound =
                marker != 0xC4 || is_sound_huffman_segment(bytes.subspan(at + 4, length - 2));
            if (!sound) return false;
            at += 2 + length;
        }
    }
    return false;
}

void check_whole(Bytes bytes, const std::string& name) {
    const bool png = begins_with(bytes, png_signature), jpeg = begins_with(bytes, jpeg_signature);
    if (!png && !jpeg)
        throw FileFormatError(name + " is neither a PNG nor a JPEG",
                              "save the picture as one of these");
    if (png ? is_whole_png(bytes) : is_whole_jpeg(bytes)) return;
    throw FileFormatError(name + " is damaged, or ends before the picture does",
                          "save or copy the picture again");
}

const stbi_uc* stb_bytes(Bytes bytes) {
    return reinterpret_cast<const stbi_uc*>(bytes.data());
}

FileFormatError damaged(const std::string& name) {
    return {name + " is damaged: " + stbi_failure_reason(), "save or copy the picture again"};
}

// Before stb allocates: a header may announce any size.
void check_size(Bytes bytes, const std::string& name) {
    constexpr int most_px = 16384;
    // Deflate makes 1 byte of at most 1032, and a byte holds at most 8 pixels. A JPEG's are fewer.
    constexpr std::uint64_t most_pixels_a_byte = 1032 * 8, most_pixels = 1 << 26;
    Picture head;
    if (!stbi_info_from_memory(stb_bytes(bytes), int(bytes.size()), &head.width, &head.height,
                               &head.channels))
        throw damaged(name);
    const std::uint64_t pixels = std::uint64_t(head.width) * std::uint64_t(head.height);
    if (head.width <= most_px && head.height <= most_px && pixels <= most_pixels &&
        pixels <= most_pixels_a_byte * bytes.size())
        return;
    throw FileFormatError(name + " announces " + std::to_string(head.width) + " x " +
                              std::to_string(head.height) + " pixels in " +
                              std::to_string(bytes.size()) + " bytes",
                          "use a picture of at most " + std::to_string(most_px) +
                              " pixels a side and " + std::to_string(most_pixels) + " in all");
}

}  // namespace

Picture decode_picture(Bytes bytes, const std::string& name) {
    if (bytes.size() > INT_MAX)
        throw FileFormatError(name + " has " + std::to_string(bytes.size()) + " bytes",
                              "use a picture of less than 2 GiB");
    check_whole(bytes, name);
    check_size(bytes, name);
    Picture picture;
    const std::unique_ptr<stbi_us, decltype(&std::free)> values{
        stbi_load_16_from_memory(stb_bytes(bytes), int(bytes.size()), &picture.width,
                                 &picture.height, &picture.channels, 0),
        &std::free};
    if (!values) throw damaged(name);
    const std::size_t count =
        std::size_t(picture.width) * std::size_t(picture.height) * std::size_t(picture.channels);
    picture.values.assign(values.get(), values.get() + count);
    return picture;
}

bool inflate(Bytes deflated, std::span<std::byte> to) {
    if (deflated.size() > INT_MAX || to.size() > INT_MAX) return false;
    const int count = stbi_zlib_decode_noheader_buffer(
        reinterpret_cast<char*>(to.data()), int(to.size()),
        reinterpret_cast<const char*>(deflated.data()), int(deflated.size()));
    return count == int(to.size());
}

}  // namespace opacity
