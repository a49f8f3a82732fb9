// The head that the demo's hair grows on, with neck and shoulders, in centimetres; z is up, the
// face looks along -y, and the ground is z = 0.
//
// Only + - * / and sqrt are used: IEEE 754 rounds these alike everywhere, which it does not ask of
// sin and pow, and the demo promises the same hair on every machine.
#pragma once

#include <glm/glm.hpp>
#include <memory>

#include "opacity/scene/mesh.hpp"

namespace opacity::demo {

// Where the head's surface lies in a direction of length 1 from its centre.
glm::dvec3 head_point(const glm::dvec3& direction);
// Positive where hair grows: above a line from the forehead over the ears to the nape.
double scalp_height(const glm::dvec3& direction);
// The point itself, or, where it is nearer than `gap` to head, shoulders or ground, moved out to
// that.
glm::dvec3 outside(const glm::dvec3& point, double gap);

std::shared_ptr<Mesh> bust();

}  // namespace opacity::demo
