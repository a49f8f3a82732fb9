// The maps of density clustering, and what fills and reads them without OpenGL. GLSL:
// techniques/density_clustering.glsl.
#pragma once

#include <functional>
#include <memory>

#include "map/lookup.hpp"
#include "opacity/technique.hpp"

namespace opacity::techniques {

constexpr int most_clusters = 16;
constexpr int clusters_per_group = 4;  // each in a channel of its own
constexpr int limits_layers = 3;       // of a group: means, reaches, optical depths

inline int cluster_groups(int clusters) {
    return (clusters + clusters_per_group - 1) / clusters_per_group;
}

// Where the clusters of each texel lie: where a pass has found them, or, before, evenly between the
// first and the last caster.
struct ClusterMeans {
    int count = 0;
    Texture *start = nullptr, *end = nullptr;
    Texture* found = nullptr;
};

// The moments of what falls to each cluster: of a group `orders` layers.
struct ClusterSums {
    Texture& map;
    int orders;
    ClusterMeans former;  // by which it falls, and about which the moments are
};

std::function<void(PassContext&)> sums_on_cpu(const ShadowInputs& inputs, const ClusterSums& sums,
                                              int first_group, int group_count);
// Means, or limits: as many layers a group as `found` has.
std::function<void(PassContext&)> clusters_on_cpu(const ClusterSums& sums, Texture& found);
// For LookUp::on_cpu.
std::function<std::unique_ptr<TexelMap>(PassContext&)> clusters_look_up(const ClusterMeans& former,
                                                                        Texture& limits);

}  // namespace opacity::techniques
