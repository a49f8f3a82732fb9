#include "techniques/scattered_layers.hpp"

#include <cstdint>
#include <utility>

namespace opacity::techniques {
namespace {

// An image each of the planes' and of the moments', or one texel for all.
TextureDesc carries_desc(const DrawnLayers& drawn, bool carries) {
    TextureDesc desc{.format = Format::r32ui, .layers = 1};
    if (!carries) return desc;
    desc = drawn.map.desc();
    desc.format = Format::r32ui;
    if (drawn.moments) desc.layers *= 2;
    return desc;
}

std::string scatter_into(PassContext& context, const Scatter& scatter, const DrawnLayers& drawn,
                         Texture& carries, bool with_carries) {
    context.resize(carries, carries_desc(drawn, with_carries));
    context.zero(carries);
    context.zero(drawn.map);
    if (drawn.moments) context.zero(*drawn.moments);
    return scatter.run(context);
}

}  // namespace

void add_scattered_layers(FrameGraph& graph, const Scatter& scatter, const DrawnLayers& drawn,
                          const Shader& shader, Reads reads, const std::string& why) {
    const std::string name = drawn.map.shader_name();
    Texture& carries = graph.growing_texture(name + "/carries", Format::r32ui);
    std::vector<Resource*> stores{&drawn.map, &carries};
    if (drawn.moments) stores.push_back(drawn.moments);
    graph.add({.name = name,
               .shader = shader,
               .draws = &scatter.inputs().translucent,
               .view = &scatter.inputs().light,
               .reads = std::move(reads),
               // Nothing is tested: it gives the size of what is drawn, where the layers' maps hold
               // but a part of the texels.
               .tests = &scatter.inputs().opaque_depth,
               .stores = std::move(stores),
               .execute = [=, &carries](PassContext& context) {
                   std::string note = scatter_into(context, scatter, drawn, carries, false);
                   const bool carry = context.read<std::uint32_t>(carries)[0] > 0;
                   if (carry) {  // once more, now that there is room for them
                       scatter_into(context, scatter, drawn, carries, true);
                       note += ", twice for carries";
                   }
                   const TextureDesc& desc = drawn.map.desc();
                   context.dispatch(desc.width * desc.height, {{"u_carries", carry}});
                   context.note(note + "; " + why);
               }});
}

}  // namespace opacity::techniques
