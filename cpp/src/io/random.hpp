// Random numbers that are the same everywhere: the standard's distributions differ between
// libraries. For the same reason never draw twice in one expression: C++ leaves open which operand
// comes first (inside braces it does not).
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

namespace opacity {

// SplitMix64 (Steele, Lea, Flood: Fast splittable pseudorandom number generators, 2014).
class Random {
   public:
    // Streams of one seed are independent: what is drawn from one does not shift another.
    Random(std::uint64_t seed, std::uint64_t stream) : state_{mixed(mixed(seed) + stream)} {}

    double uniform() { return double(next() >> 11) * 0x1p-53; }  // in [0, 1)
    double uniform(double low, double high) { return low + (high - low) * uniform(); }
    // In -1 .. 1, most often near 0.
    double around_zero() {
        const double first = uniform();
        return first - uniform();
    }
    glm::dvec3 unit_vector() {
        for (;;) {
            const double x = uniform(-1, 1), y = uniform(-1, 1), z = uniform(-1, 1);
            const glm::dvec3 v{x, y, z};
            const double squared = glm::dot(v, v);
            if (squared <= 1.0 && squared > 1e-4) return v / glm::sqrt(squared);
        }
    }

   private:
    static std::uint64_t mixed(std::uint64_t z) {
        z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
        z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
        return z ^ (z >> 31);
    }
    std::uint64_t next() { return mixed(state_ += 0x9E3779B97F4A7C15u); }

    std::uint64_t state_;
};

}  // namespace opacity
