// Smooth noise for generated scenes: smoke, clouds, wind in the grass, patches of colour.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>

namespace opacity::demo {

// Gradient noise (Perlin: Improving noise, 2002) on a lattice of edge 1 that repeats after 256.
class Noise {
   public:
    // As Random: streams of one seed are independent.
    Noise(std::uint64_t seed, std::uint64_t stream);

    // About -1 .. 1, most often near 0; 0 at the lattice's points.
    double at(const glm::dvec3& p) const;
    // Octaves of twice the frequency and half the size each, together about -1 .. 1.
    double fractal(const glm::dvec3& p, int octaves) const;
    // As fractal, with round bulges outward and creases between them, as on cauliflower and
    // cumulus.
    double billows(const glm::dvec3& p, int octaves) const;
    // Three independent ones.
    glm::dvec3 vector(const glm::dvec3& p) const;

   private:
    template <class Shaped>
    double octaves(const glm::dvec3& p, int count, const Shaped& shaped) const;

    std::array<std::uint8_t, 512> shuffled_;  // a permutation, twice
};

}  // namespace opacity::demo
