// Gzip (RFC 1952), one member.
#pragma once

#include <optional>
#include <vector>

#include "io/stb_decode.hpp"

namespace opacity {

// Nothing unless the bytes are whole, sound, and become exactly `size`; memory is asked for only
// where so few bytes can become as many.
std::optional<std::vector<std::byte>> gunzipped(Bytes bytes, std::uint64_t size);

}  // namespace opacity
