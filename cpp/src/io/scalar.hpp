// Numbers as binary files hold them.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>

namespace opacity {

enum class ScalarType {
    int8,
    uint8,
    int16,
    uint16,
    int32,
    uint32,
    int64,
    uint64,
    float32,
    float64
};

inline std::size_t size_of(ScalarType type) {
    constexpr std::size_t sizes[] = {1, 1, 2, 2, 4, 4, 8, 8, 4, 8};
    return sizes[std::size_t(type)];
}

inline bool is_float(ScalarType type) {
    return type == ScalarType::float32 || type == ScalarType::float64;
}

template <class Number>
Number scalar_at(const std::byte* at, std::endian order) {
    std::byte bytes[sizeof(Number)];
    for (std::size_t i = 0; i < sizeof(Number); ++i)
        bytes[i] = at[order == std::endian::native ? i : sizeof(Number) - 1 - i];
    Number value;
    std::memcpy(&value, bytes, sizeof value);
    return value;
}

// Exact up to 2^53, beyond that the nearest double.
inline double scalar_at(const std::byte* at, ScalarType type, std::endian order) {
    switch (type) {
        case ScalarType::int8:
            return scalar_at<std::int8_t>(at, order);
        case ScalarType::uint8:
            return scalar_at<std::uint8_t>(at, order);
        case ScalarType::int16:
            return scalar_at<std::int16_t>(at, order);
        case ScalarType::uint16:
            return scalar_at<std::uint16_t>(at, order);
        case ScalarType::int32:
            return scalar_at<std::int32_t>(at, order);
        case ScalarType::uint32:
            return scalar_at<std::uint32_t>(at, order);
        case ScalarType::int64:
            return double(scalar_at<std::int64_t>(at, order));
        case ScalarType::uint64:
            return double(scalar_at<std::uint64_t>(at, order));
        case ScalarType::float32:
            return scalar_at<float>(at, order);
        default:
            return scalar_at<double>(at, order);
    }
}

}  // namespace opacity
