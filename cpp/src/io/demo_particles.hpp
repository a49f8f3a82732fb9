// The particles of generated scenes, one by one.
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <memory>
#include <utility>
#include <vector>

#include "opacity/scene/particles.hpp"

namespace opacity::demo {

class ParticleArrays {
   public:
    explicit ParticleArrays(std::size_t count) {
        xyz_.reserve(3 * count);
        radius_.reserve(count);
        opacity_.reserve(count);
        color_.reserve(count);
    }

    void add(const glm::dvec3& center, double radius, double opacity, const glm::dvec3& color) {
        xyz_.insert(xyz_.end(), {float(center.x), float(center.y), float(center.z)});
        radius_.push_back(float(radius));
        opacity_.push_back(float(opacity));
        color_.push_back({float(color.x), float(color.y), float(color.z)});
    }

    std::shared_ptr<Particles> particles() && {
        return std::make_shared<Particles>(Positions{std::move(xyz_)}, std::move(radius_),
                                           std::move(opacity_), std::move(color_));
    }

   private:
    std::vector<float> xyz_, radius_, opacity_;
    std::vector<float3> color_;
};

}  // namespace opacity::demo
