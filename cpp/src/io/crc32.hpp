// The checksum of gzip and PNG (ISO 3309, polynomial 0xEDB88320 with the bits turned).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace opacity {

inline std::uint32_t crc32(std::span<const std::byte> bytes) {
    static constexpr auto table = [] {
        std::array<std::uint32_t, 256> rows{};
        for (std::uint32_t i = 0; i < 256; ++i) {
            rows[i] = i;
            for (int bit = 0; bit < 8; ++bit)
                rows[i] = rows[i] & 1 ? 0xEDB8'8320u ^ rows[i] >> 1 : rows[i] >> 1;
        }
        return rows;
    }();
    std::uint32_t sum = 0xFFFF'FFFF;
    for (const std::byte b : bytes) sum = table[(sum ^ std::uint32_t(b)) & 0xFF] ^ sum >> 8;
    return ~sum;
}

}  // namespace opacity
