// Clusters of casters along a texel, in the order of their mean depths. A caster is of the cluster
// whose mean is nearest: each has a cell, from the middle toward the mean before to that toward the
// next. GLSL: lib/clusters.glsl.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

#include "map/interval.hpp"

namespace opacity {

struct Cell {
    float begin, end;
};

// From where to where cell k lies; the outer two reach beyond all casters.
inline Cell cell_of(std::span<const float> means, std::size_t k) {
    return {k > 0 ? 0.5f * (means[k - 1] + means[k]) : -1.f,
            k + 1 < means.size() ? 0.5f * (means[k] + means[k + 1]) : 2.f};
}

// Optical depth, that times the distance from some depth, and that times its square.
struct ClusterMoments {
    float optical_depth, first, second;
};

// Of what a cell holds of a caster, about a depth. Optical depth is even from its begin to its end;
// one on a border is of the cell behind.
inline ClusterMoments cell_moments(const Cell& cell, float begin, float end, float optical_depth,
                                   float about) {
    const float held = optical_depth * (part_in_front(begin, end, cell.end) -
                                        part_in_front(begin, end, cell.begin));
    const float low = std::max(begin, cell.begin), high = std::min(end, cell.end);
    const float shift = 0.5f * (low + high) - about, half_length = 0.5f * (high - low);
    return {held, held * shift, held * (shift * shift + half_length * half_length / 3.f)};
}

// What light meets of a cluster: optical depth that grows evenly as far as `reach` to both sides of
// the mean.
struct Cluster {
    float mean, reach, optical_depth;
};

// What float32 leaves of the variance of one depth, over the square of its distance.
constexpr float rounded_variance = 1e-6f;

// An even medium reaches sqrt(3) standard deviations to each side of its mean.
inline Cluster cluster_of(const ClusterMoments& moments, float about) {
    if (!(moments.optical_depth > 0.f)) return {about, 0.f, 0.f};
    const float shift = moments.first / moments.optical_depth, square = shift * shift;
    const float variance = moments.second / moments.optical_depth - square;
    return {about + shift, variance > rounded_variance * square ? std::sqrt(3.f * variance) : 0.f,
            moments.optical_depth};
}

// Without a caster, of which the cluster holds this about its mean.
inline Cluster without(const Cluster& cluster, const ClusterMoments& own) {
    const float square = cluster.reach * cluster.reach / 3.f;
    return cluster_of({cluster.optical_depth - own.optical_depth, -own.first,
                       cluster.optical_depth * square - own.second},
                      cluster.mean);
}

inline float optical_depth_before(float depth, const Cluster& cluster) {
    return cluster.optical_depth *
           part_in_front(cluster.mean - cluster.reach, cluster.mean + cluster.reach, depth);
}

}  // namespace opacity
