#include "render/first_surfaces.hpp"

#include <algorithm>

namespace opacity::render {

std::vector<Texture*> add_first_surfaces(FrameGraph& graph, const PictureInputs& inputs,
                                         const Shading& shading) {
    std::vector<Texture*> surfaces;
    TextureDesc desc{.format = Format::rgba32f,
                     .width = inputs.settings.width.get(),
                     .height = inputs.settings.height.get()};
    for (std::size_t light = 0; light < inputs.lights.size(); ++light) {
        const LightScope scope{graph, inputs, light};
        desc.format = Format::rgba32f;
        surfaces.push_back(&graph.texture("first_surface", desc));
        desc.format = Format::depth32f;
        Texture& depth = graph.texture("first_surface_depth", desc);
        Pass pass = shading.pass("first_surface", inputs, light, inputs.lists.surfaces, false,
                                 {{"TOLD", "1"}});
        pass.writes = {surfaces.back(), &depth};
        pass.state = {
            .depth = Depth::greater, .clear_depth = 0.f, .clear_color = {1.f, -1.f, -1.f, 0.f}};
        graph.add(std::move(pass));
    }
    return surfaces;
}

std::vector<float4> with_scene_indices(std::vector<float4> surfaces, const DrawList& list,
                                       const Scene& scene) {
    std::vector<float> index_in_scene;
    for (const ShapePtr& shape : list.shapes()) {
        const auto& all = scene.shapes();
        index_in_scene.push_back(float(std::find(all.begin(), all.end(), shape) - all.begin()));
    }
    for (float4& seen : surfaces)
        if (seen[2] >= 0.f) seen[2] = index_in_scene[std::size_t(seen[2])];
    return surfaces;
}

}  // namespace opacity::render
