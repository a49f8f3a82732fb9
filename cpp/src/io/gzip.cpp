#include "io/gzip.hpp"

#include "io/crc32.hpp"
#include "io/scalar.hpp"

namespace opacity {
namespace {

// Where the deflated bytes begin; 0 where the header is none.
std::size_t header_size(Bytes bytes) {
    constexpr std::size_t fixed = 10;
    enum Flag { header_checksum = 2, extra = 4, name = 8, comment = 16 };
    const auto at = [&](std::size_t i) { return i < bytes.size() ? unsigned(bytes[i]) : 0u; };
    if (at(0) != 0x1F || at(1) != 0x8B || at(2) != 8) return 0;
    const unsigned flags = at(3);
    std::size_t size = fixed;
    if (flags & extra) size += 2 + at(fixed) + 256 * at(fixed + 1);
    for (const unsigned flag : {unsigned{name}, unsigned{comment}}) {
        if (!(flags & flag)) continue;
        while (size < bytes.size() && at(size) != 0) ++size;
        ++size;
    }
    return size + (flags & header_checksum ? 2 : 0);
}

}  // namespace

std::optional<std::vector<std::byte>> gunzipped(Bytes bytes, std::uint64_t size) {
    constexpr std::size_t trailer = 8;
    constexpr std::uint64_t most_growth = 1032;  // what deflate can at most do
    const std::size_t begin = header_size(bytes);
    if (begin == 0 || bytes.size() < begin + trailer) return std::nullopt;
    const Bytes content = bytes.subspan(begin), check = content.last(trailer);
    if (size > most_growth * content.size()) return std::nullopt;
    std::vector<std::byte> result(static_cast<std::size_t>(size));
    const bool whole =
        scalar_at<std::uint32_t>(&check[4], std::endian::little) == std::uint32_t(size) &&
        inflate(content, result) &&
        scalar_at<std::uint32_t>(&check[0], std::endian::little) == crc32(result);
    if (!whole) return std::nullopt;
    return result;
}

}  // namespace opacity
