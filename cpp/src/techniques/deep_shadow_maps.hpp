// Deep shadow maps: T along each texel as few nodes as an error bound allows (Lokovic and Veach
// 2000).
//
// Idea: the fragments of a texel, sorted, make T a function of depth: a step at each strand and
// surface, a fall through each interval. From the first node on, straight lines follow it as far as
// they stay within `error_bound`, and only the ends of the lines are kept; a look-up searches the
// two nodes around its depth. Where a texel ends, T is exact. With `nodes` a texel keeps that many
// at most: of all nodes the one whose triangle with its neighbours is least is dropped (adaptive
// transmittance, Salvi et al. 2010).
//
// Cost: the passes of `exact`, and two that compress; a look-up reads 8 bytes a texel and 8 a node.
// The lists stay beside them, so that memory is not saved while the maps are made.
//
// Fails: a step larger than twice the bound takes two nodes, so that few opaque fragments in a
// texel are not fewer nodes. Inside intervals the bound is 1e-4 at least.
#pragma once

#include <string_view>

#include "opacity/technique.hpp"
#include "techniques/fragment_lists.hpp"

namespace opacity::techniques {

class DeepShadowMaps : public Technique {
   public:
    DeepShadowMaps() : Technique{"deep_shadow_maps"} {}

    std::string_view summary() const override {
        return "Sorted lists of each texel, compressed to straight lines within an error bound.";
    }
    std::string_view paper() const override { return "Lokovic and Veach 2000; Salvi et al. 2010"; }
    LookUp build(FrameGraph& graph, const ShadowInputs& inputs) override;

    Param<double> error_bound{
        *this, "error_bound", 0.01, {0.0, 1.0}, "How far T may be from that of the exact lists."};
    Param<int> nodes{*this,
                     "nodes",
                     0,
                     {0, 64},
                     "The most nodes that a texel keeps, whatever the error; 0: as many as the "
                     "bound takes."};

   private:
    void add_node_count(FrameGraph& graph, const ShadowInputs& inputs, const FragmentLists& lists,
                        Texture& count) const;
    void add_nodes(FrameGraph& graph, const ShadowInputs& inputs, const FragmentLists& lists,
                   const PackedLists& places, Texture& list) const;
};

}  // namespace opacity::techniques
