// A rabbit that sits on the ground z = 0, in centimetres, and how its fur lies.
#pragma once

#include <glm/glm.hpp>
#include <memory>

#include "io/demo_coat.hpp"
#include "opacity/scene/mesh.hpp"

namespace opacity::demo {

std::shared_ptr<Mesh> rabbit();
std::shared_ptr<Mesh> rabbit_eyes();
Lie rabbit_fur(const glm::dvec3& point, const glm::dvec3& normal);

}  // namespace opacity::demo
