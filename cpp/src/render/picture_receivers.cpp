#include "render/picture_receivers.hpp"

#include <algorithm>

#include "scene/bias.hpp"

namespace opacity::render {
namespace {

// The scene about its middle, in radii of it.
double4x4 neutral_from_world(const Scene& scene) {
    const Box bounds = scene.bounds();
    if (bounds.empty()) return identity;
    const double scale = 1.0 / std::max(bounds.radius(), 1e-30);
    const double3 c = bounds.center();
    return {scale, 0, 0,     -scale * c[0], 0, scale, 0, -scale * c[1],
            0,     0, scale, -scale * c[2], 0, 0,     0, 1};
}

}  // namespace

const Resource& ReceiverPass::add(FrameGraph& graph, const PictureInputs& inputs,
                                  const Shading& shading) {
    frame_.update(neutral_from_world(inputs.scene),
                  {{"u_light_least_bias", float(least_bias(inputs.scene))}});
    TextureDesc desc{.format = Format::rgba32f,
                     .width = inputs.settings.width.get(),
                     .height = inputs.settings.height.get()};
    receivers_ = &graph.texture("receivers", desc);
    desc.format = Format::depth32f;
    Texture& depth = graph.texture("receivers_depth", desc);
    Pass pass = shading.unlit_pass("receivers", "receivers.frag.glsl", inputs.lists.surfaces);
    pass.reads.push_back(&frame_);
    pass.writes = {receivers_, &depth};
    pass.state = {.depth = Depth::greater, .clear_depth = 0.f, .clear_color = {0, 0, 0, -2}};
    graph.add(std::move(pass));
    return *receivers_;
}

PictureReceivers ReceiverPass::read(Device& device) const {
    PictureReceivers result{receivers_->desc().width, receivers_->desc().height, {}, {}};
    const std::size_t count = std::size_t(result.width) * result.height;
    std::vector<float> points(4 * count);
    device.read(*receivers_, std::as_writable_bytes(std::span{points}));
    const double4x4& m = frame_.from_world();
    result.points_ws.reserve(3 * count);
    result.bias.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
        const float* p = &points[4 * i];
        const bool is_seen = p[3] > -1.5f;
        for (int axis = 0; axis < 3; ++axis)
            result.points_ws.push_back(is_seen ? (p[axis] - m[4 * axis + 3]) / m[0] : 0.0);
        result.bias.push_back(p[3]);
    }
    return result;
}

}  // namespace opacity::render
