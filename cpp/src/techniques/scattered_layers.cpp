#include "techniques/scattered_layers.hpp"

#include <cstdint>
#include <utility>

namespace opacity::techniques {
namespace {

// What all casters add up to, a layer an image.
struct Sums {
    Texture &of_layers, &carries;
};

std::string scatter_into(PassContext& context, const Scatter& scatter, const Sums& sums,
                         const TextureDesc& desc, bool with_carries) {
    context.resize(sums.of_layers, desc);
    context.resize(sums.carries,
                   with_carries ? desc : TextureDesc{.format = Format::r32ui, .layers = 1});
    context.zero(sums.of_layers);
    context.zero(sums.carries);
    return scatter.run(context);
}

}  // namespace

void add_scattered_layers(FrameGraph& graph, const Scatter& scatter, const DrawnLayers& drawn,
                          const Shader& shader, Reads reads, const std::string& why) {
    const std::string name = drawn.map.shader_name();
    const Sums sums{graph.growing_texture(name + "/sums", Format::r32ui),
                    graph.growing_texture(name + "/carries", Format::r32ui)};
    std::vector<Resource*> stores{&drawn.map, &sums.of_layers, &sums.carries};
    if (drawn.moments) stores.push_back(drawn.moments);
    graph.add({.name = name,
               .shader = shader,
               .draws = &scatter.inputs().translucent,
               .view = &scatter.inputs().light,
               .reads = std::move(reads),
               .stores = std::move(stores),
               .execute = [=](PassContext& context) {
                   TextureDesc desc = drawn.map.desc();
                   desc.format = Format::r32ui;
                   desc.layers = (drawn.moments ? 2 : 1) * drawn.layer_count();
                   std::string note = scatter_into(context, scatter, sums, desc, false);
                   const bool carries = context.read<std::uint32_t>(sums.carries)[0] > 0;
                   if (carries) {  // once more, now that there is room for them
                       scatter_into(context, scatter, sums, desc, true);
                       note += ", twice for carries";
                   }
                   context.dispatch(desc.width * desc.height, {{"u_carries", carries}});
                   context.note(note + "; " + why);
               }});
}

}  // namespace opacity::techniques
