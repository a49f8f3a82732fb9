#include "io/demo_noise.hpp"

#include <cmath>
#include <utility>

#include "io/random.hpp"

namespace opacity::demo {
namespace {

// The product with one of the twelve directions from a cube's middle to its edges.
double along_gradient(std::uint8_t hash, const glm::dvec3& p) {
    const int axis = hash % 3;
    const double a = p[(axis + 1) % 3], b = p[(axis + 2) % 3];
    return (hash & 0x40 ? a : -a) + (hash & 0x80 ? b : -b);
}

double mix(double a, double b, double t) {
    return a + t * (b - a);
}

}  // namespace

Noise::Noise(std::uint64_t seed, std::uint64_t stream) {
    Random random{seed, stream};
    for (std::size_t i = 0; i < 256; ++i) shuffled_[i] = std::uint8_t(i);
    for (std::size_t i = 255; i > 0; --i)
        std::swap(shuffled_[i], shuffled_[std::size_t(random.uniform() * double(i + 1))]);
    for (std::size_t i = 0; i < 256; ++i) shuffled_[i + 256] = shuffled_[i];
}

double Noise::at(const glm::dvec3& p) const {
    const glm::dvec3 whole = glm::floor(p), q = p - whole;
    const glm::dvec3 fade = q * q * q * (q * (q * 6.0 - 15.0) + 10.0);
    const auto cell = [&](int axis) { return std::size_t(std::int64_t(whole[axis]) & 255); };
    const std::size_t x = cell(0), y = cell(1), z = cell(2);
    const auto corner = [&](std::size_t dx, std::size_t dy, std::size_t dz) {
        const std::size_t column = shuffled_[shuffled_[x + dx] + y + dy];
        return along_gradient(shuffled_[column + ((z + dz) & 255)],
                              q - glm::dvec3{double(dx), double(dy), double(dz)});
    };
    const auto edge = [&](std::size_t dy, std::size_t dz) {
        return mix(corner(0, dy, dz), corner(1, dy, dz), fade.x);
    };
    return mix(mix(edge(0, 0), edge(1, 0), fade.y), mix(edge(0, 1), edge(1, 1), fade.y), fade.z);
}

template <class Shaped>
double Noise::octaves(const glm::dvec3& p, int count, const Shaped& shaped) const {
    double sum = 0.0, frequency = 1.0, size = 1.0;
    for (int octave = 0; octave < count; ++octave, frequency *= 2.0, size *= 0.5)
        sum += size * shaped(at(frequency * p + double(octave) * glm::dvec3{17.3, 9.1, 5.7}));
    return sum;
}

double Noise::fractal(const glm::dvec3& p, int count) const {
    return octaves(p, count, [](double value) { return value; });
}

double Noise::billows(const glm::dvec3& p, int count) const {
    return octaves(p, count, [](double value) { return 2.4 * std::abs(value) - 0.6; });
}

glm::dvec3 Noise::vector(const glm::dvec3& p) const {
    const double x = at(p), y = at(p + glm::dvec3{31.4, 15.9, 26.5}),
                 z = at(p + glm::dvec3{-27.1, 82.8, -18.2});
    return {x, y, z};
}

}  // namespace opacity::demo
