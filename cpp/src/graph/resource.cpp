#include "opacity/graph/resource.hpp"

#include <algorithm>

#include "opacity/graph/device.hpp"
#include "opacity/graph/draw_list.hpp"

namespace opacity {

int channels(Format format) {
    switch (format) {
        case Format::rgba32f:
        case Format::rgba16f:
        case Format::rgba8:
        case Format::rgba32ui:
            return 4;
        default:
            return 1;
    }
}

namespace {

std::size_t values_in(const TextureDesc& desc) {
    const std::size_t scale = content_scale(desc);
    return scale * scale * desc.width * desc.height * std::max(desc.layers, 1) *
           channels(desc.format);
}

std::size_t stored_bytes_of_channel(Format format) {
    return format == Format::rgba16f ? 2 : format == Format::rgba8 ? 1 : 4;
}

}  // namespace

std::size_t size_bytes(const TextureDesc& desc) {
    return values_in(desc) * 4;
}

std::size_t stored_bytes(const TextureDesc& desc) {
    return values_in(desc) * stored_bytes_of_channel(desc.format);
}

void ShapePart::update(std::vector<Revision> signature) {
    if (signature == signature_) return;
    signature_ = std::move(signature);
    touch();
}

void DrawList::update(std::vector<ShapePtr> shapes) {
    shapes_ = std::move(shapes);
    std::vector<Revision> geometry_now, opacity_now, color_now;
    for (const ShapePtr& shape : shapes_) {
        const auto lock = shape->lock();
        const Shape::Revisions& now = shape->revisions();
        geometry_now.insert(geometry_now.end(), {now.geometry, now.transform});
        opacity_now.push_back(now.opacity);
        // What the camera sees of a shape: its colour, whether it receives, and whether it is
        // opaque.
        color_now.insert(color_now.end(), {now.color, now.flags, shape->opaque() ? 1u : 0u});
    }
    geometry.update(std::move(geometry_now));
    opacity.update(std::move(opacity_now));
    color.update(std::move(color_now));
}

}  // namespace opacity
