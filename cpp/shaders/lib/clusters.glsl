// CLUSTERS of casters along a texel, in the order of their mean depths. A caster is of the cluster
// whose mean is nearest: each has a cell, from the middle toward the mean before to that toward the
// next. C++: map/clusters.hpp.
#include "lib/interval.glsl"

// From where to where cell k lies; the outer two reach beyond all casters.
vec2 cell_of(float means[CLUSTERS], int k) {
    return vec2(k > 0 ? 0.5 * (means[k - 1] + means[k]) : -1.0,
                k + 1 < CLUSTERS ? 0.5 * (means[k] + means[k + 1]) : 2.0);
}

// Optical depth, that times the distance from a depth `about`, and that times its square: of what a
// cell holds of a caster. Optical depth is even from its begin to its end; one on a border is of the
// cell behind.
vec3 cell_moments(vec2 cell, float begin, float end, float optical_depth, float about) {
    float held = optical_depth * (part_in_front(begin, end, cell.y) - part_in_front(begin, end, cell.x));
    float low = max(begin, cell.x), high = min(end, cell.y);
    float shift = 0.5 * (low + high) - about, half_length = 0.5 * (high - low);
    return held * vec3(1.0, shift, shift * shift + half_length * half_length / 3.0);
}

// What light meets of a cluster: optical depth that grows evenly as far as `reach` to both sides of
// the mean.
struct Cluster {
    float mean, reach, optical_depth;
};

// What float32 leaves of the variance of one depth, over the square of its distance.
const float rounded_variance = 1e-6;

// An even medium reaches sqrt(3) standard deviations to each side of its mean.
Cluster cluster_of(vec3 moments, float about) {
    if (!(moments.x > 0.0)) return Cluster(about, 0.0, 0.0);
    float shift = moments.y / moments.x, square = shift * shift;
    float variance = moments.z / moments.x - square;
    return Cluster(about + shift, variance > rounded_variance * square ? sqrt(3.0 * variance) : 0.0, moments.x);
}

// Without a caster, of which the cluster holds this about its mean.
Cluster without(Cluster cluster, vec3 moments) {
    float square = cluster.reach * cluster.reach / 3.0;
    return cluster_of(cluster.optical_depth * vec3(1.0, 0.0, square) - moments, cluster.mean);
}

float optical_depth_before(float depth, Cluster cluster) {
    return cluster.optical_depth * part_in_front(cluster.mean - cluster.reach, cluster.mean + cluster.reach, depth);
}
