// Boulders: opaque bodies among the translucent ones.
#pragma once

#include <glm/glm.hpp>

#include "io/demo_noise.hpp"
#include "io/demo_triangles.hpp"

namespace opacity::demo {

// Its lower part lies in the ground.
void add_stone(Triangles& mesh, const glm::dvec3& center, double radius, const Noise& noise);

}  // namespace opacity::demo
