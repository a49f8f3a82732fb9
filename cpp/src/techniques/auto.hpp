// Auto: the technique that a scene is best served by, found before the first pass.
//
// Idea: where few translucent casters lie in a texel, the exact lists have no error, take less
// memory than layers, and are made in less time; where many do, adaptive opacity maps err least of
// all that keep layers, or as little as the least, on every scene of docs/accuracy_tables.md. How
// many there will be follows from the scene's lengths and areas. The number of layers follows from
// `error_budget` by how errors were measured to fall: with the square root of the layers for
// strands, faster for leaves, and for particles and volumes faster than the layers.
//
// Cost: that of what it picks; the estimate is made again only when a shape moves. The report has
// the choice and why in the row "technique".
//
// Fails: the estimate takes casters for spread over the map and in all directions alike. Where they
// are not, lists may be longer than thought, never wrong; what was promised of layers was measured
// on scenes at 512^2, where texels hold up to some 20 casters.
#pragma once

#include <map>
#include <memory>
#include <string_view>

#include "map/caster_load.hpp"
#include "opacity/technique.hpp"

namespace opacity::techniques {

class Auto : public Technique {
   public:
    Auto() : Technique{"auto"} {}

    std::string_view summary() const override {
        return "Exact lists or adaptive maps, and their layers, as the scene and an error budget "
               "have it.";
    }
    std::string_view paper() const override { return "own: docs/comparison.md"; }
    Delegate delegate(const Scene& scene, const LightSpace& space) override;
    LookUp build(FrameGraph& graph, const ShadowInputs& inputs) override;
    void needs_recompute() override;

    Param<double> error_budget{*this,
                               "error_budget",
                               0.02,
                               {0.0, 1.0},
                               "RMSE of T against the exact lists that layers are chosen for; 0: "
                               "none at all."};
    AutoParam<int> layers{*this, "layers", {1, 64}, "Of adaptive maps; auto: by error_budget."};
    Param<int> memory{
        *this, "memory", 512, {1, 65536}, "MiB of a light's maps that exact lists may take."};

   private:
    int layers_for_budget() const;
    // As it is set now; kept for as long as this is, since passes refer to its parameters.
    const std::shared_ptr<Technique>& exact();
    const std::shared_ptr<Technique>& layered_maps(int layer_count);

    CasterLoad load_;
    std::map<int, std::shared_ptr<Technique>> made_;  // by layers; exact lists: 0
};

}  // namespace opacity::techniques
