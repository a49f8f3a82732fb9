#include "render/scene_lists.hpp"

namespace opacity::render {

void SceneLists::update(const Scene& scene) {
    std::vector<ShapePtr> translucent_casters, opaque_casters;
    for (const ShapePtr& shape : scene.shapes()) {
        const auto lock = shape->lock();
        if (!shape->is_caster()) continue;
        (shape->opaque() ? opaque_casters : translucent_casters).push_back(shape);
    }
    translucent.update(std::move(translucent_casters));
    opaque.update(std::move(opaque_casters));
    visible.update(scene.shapes());
}

}  // namespace opacity::render
