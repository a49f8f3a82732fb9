// Density clustering (Mertens, Kautz, Bekaert and Van Reeth, "A Self-Shadow Algorithm for Dynamic
// Hair using Density Clustering", Eurographics Symposium on Rendering 2004).
//
// Idea: in each texel the casters form a few clusters along the light, found by k-means. Means lie
// evenly between the first and the last caster, and `iterations` times move to the mean depth of
// the casters nearest to them. Then the optical depth, the mean and the standard deviation of each
// cluster are summed, and its layer reaches sqrt(3) standard deviations to both sides of the mean:
// as far as an even medium of that deviation does. Casters weigh by their optical depth, so that
// means do not depend on the map's size; of particles and volumes each cluster gets its part.
//
// Cost: 2 depth passes, a blended one each iteration and one for the layers: four with the
// defaults, as in the paper; the last is two beyond 8 clusters. 8 bytes a texel, and for every four
// clusters 48 each iteration and 96 for the layers. As in Yuksel and Keyser 2008 the layers' limits
// are computed before any look-up, which reads 4 texels, 48 bytes for every four clusters of each.
//
// Fails: the first layer may begin before the first caster, so that the lit surface is darkened;
// where a few casters share a cluster, T falls between them; k-means jumps from texel to texel,
// which shows as noise; every cluster costs at every look-up, so that many are slow.
#pragma once

#include <string_view>

#include "techniques/clusters_on_cpu.hpp"
#include "techniques/own_corrected.hpp"

namespace opacity::techniques {

class DensityClustering : public OwnCorrected {
   public:
    DensityClustering() : OwnCorrected{"density_clustering"} {}

    std::string_view summary() const override {
        return "Layers about the clusters that k-means finds along each texel.";
    }
    std::string_view paper() const override { return "Mertens et al. 2004"; }
    LookUp build(FrameGraph& graph, const ShadowInputs& inputs) override;

    Param<int> clusters{*this, "clusters", 4, {1, most_clusters}, "Clusters, and layers, a texel."};
    Param<int> iterations{*this,
                          "iterations",
                          1,
                          {0, 8},
                          "Of k-means, a pass each, before the layers are drawn; 0: casters go to "
                          "the nearest of evenly spaced means."};

   private:
    // Passes that sum the first `orders` moments of what each cluster holds.
    Texture& add_sums(FrameGraph& graph, const ShadowInputs& inputs, const ClusterMeans& former,
                      int orders) const;
    // A pass that makes of these sums where the clusters lie.
    void add_found(FrameGraph& graph, const ShadowInputs& inputs, const ClusterSums& sums,
                   Texture& found) const;
};

}  // namespace opacity::techniques
