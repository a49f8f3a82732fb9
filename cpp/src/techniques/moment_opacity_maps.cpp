#include "techniques/moment_opacity_maps.hpp"

#include <string>

#include "map/moments.hpp"

namespace opacity::techniques {

LookUp MomentOpacityMaps::build(FrameGraph& graph, const ShadowInputs& inputs) {
    const int count = moments.get() + 1;
    const Coefficients sums{coefficients_texture(graph, inputs, Format::rgba32f, count),
                            count,
                            {},
                            std::make_shared<PowerMoments>(moments.get()),
                            {},
                            {{"MOMENTS", std::to_string(moments.get())}}};
    return coefficients_look_up(inputs, add_coefficients(graph, inputs, sums));
}

}  // namespace opacity::techniques
