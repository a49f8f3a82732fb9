#include "scene/primitives.hpp"

#include "opacity/scene/mesh.hpp"
#include "opacity/scene/particles.hpp"
#include "opacity/scene/strands.hpp"

namespace opacity {

Primitives::Primitives(const Shape& shape) {
    if (const auto* strands = dynamic_cast<const Strands*>(&shape)) {
        indices_ = strands->segments().data();
        corners_ = 2;
        count_ = strands->segments().size();
    } else if (const auto* mesh = dynamic_cast<const Mesh*>(&shape)) {
        indices_ = mesh->triangles().data();
        corners_ = 3;
        count_ = mesh->triangles().size() / 3;
    } else if (dynamic_cast<const Particles*>(&shape)) {
        count_ = shape.points().size();
    }
}

}  // namespace opacity
