// What stb_image does here: PNG and JPEG pictures, and the inflate that is part of the first.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace opacity {

using Bytes = std::span<const std::byte>;

// As it is stored, by rows from the top; 8 bits are stretched to 16, which keeps every ratio.
struct Picture {
    int width = 0, height = 0;
    int channels = 0;  // grey, grey and alpha, RGB, or RGB and alpha
    std::vector<std::uint16_t> values;

    bool has_alpha() const { return channels == 2 || channels == 4; }
};

// FileFormatError that begins with `name` where the bytes are no whole PNG or JPEG, or where so few
// bytes cannot hold as many pixels as they announce.
Picture decode_picture(Bytes bytes, const std::string& name);

// Deflated bytes without a header (RFC 1951), with the checksum of four bytes or more that stands
// behind them in every format: stb reads ahead. False unless they are whole and fill `to` exactly.
bool inflate(Bytes deflated, std::span<std::byte> to);

}  // namespace opacity
