#include "scene/bias.hpp"

#include <algorithm>

namespace opacity {

double least_bias(const Scene& scene) {
    Box translucent, opaque;  // in world space
    for (const ShapePtr& shape : scene.shapes()) {
        const auto lock = shape->lock();
        if (shape->is_caster()) (shape->opaque() ? opaque : translucent).extend(shape->bounds());
    }
    // A wide opaque ground must not widen the bias within hair.
    const double radius = translucent.empty() ? opaque.radius() : translucent.radius();
    return std::max(1e-4 * radius, 1e-30);
}

double mean_strand_width(const std::vector<ShapePtr>& shapes) {
    double sum = 0.0, points = 0.0;
    for (const ShapePtr& shape : shapes) {
        const auto lock = shape->lock();
        if (!shape->is_caster() || shape->strand_width() == 0.0) continue;
        sum += double(shape->points().size()) * shape->strand_width();
        points += double(shape->points().size());
    }
    return points > 0.0 ? sum / points : 0.0;
}

}  // namespace opacity
