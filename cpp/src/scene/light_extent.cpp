#include "scene/light_extent.hpp"

#include <algorithm>

namespace opacity {

const Box& CasterBoxes::box(const Shape& shape, const Key& key, const Place& place) {
    Cached& cached = cache_[&shape];
    const Shape::Revisions& now = shape.revisions();
    if (cached.geometry == now.geometry && cached.transform == now.transform && cached.key == key)
        return cached.box;
    Box box;
    for (std::size_t i = 0; i < shape.points().size(); ++i)
        box.extend(place(transform_point(shape.transform(), shape.points()[i])));
    cached = {now.geometry, now.transform, key, box};
    return cached.box;
}

void CasterBoxes::forget_absent(const Scene& scene) {
    std::erase_if(cache_, [&](const auto& entry) {
        return std::none_of(scene.shapes().begin(), scene.shapes().end(),
                            [&](const ShapePtr& shape) { return shape.get() == entry.first; });
    });
}

}  // namespace opacity
