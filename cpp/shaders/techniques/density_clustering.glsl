// Density clustering: see density_clustering.hpp. Four clusters a group, each in a channel of its own;
// of a group the map of sums keeps ORDERS layers, one moment each.
#include "lib/clusters.glsl"

const int groups = (CLUSTERS + 3) / 4;

// Where the clusters of a texel were before, which says what falls to whom: at first evenly between
// the first and the last caster.
#ifdef EVEN_MEANS
uniform sampler2D t_start, t_end;

float[CLUSTERS] former_means(ivec2 texel) {
    float start = texelFetch(t_start, texel, 0).x, end = texelFetch(t_end, texel, 0).x;
    float means[CLUSTERS];
    for (int k = 0; k < CLUSTERS; ++k) means[k] = start + (end - start) * ((float(k) + 0.5) / float(CLUSTERS));
    return means;
}
#else
uniform sampler2DArray t_means;

float[CLUSTERS] former_means(ivec2 texel) {
    float means[CLUSTERS];
    for (int group = 0; group < groups; ++group) {
        vec4 here = texelFetch(t_means, ivec3(texel, group), 0);
        for (int i = 0; i < 4 && 4 * group + i < CLUSTERS; ++i) means[4 * group + i] = here[i];
    }
    return means;
}
#endif

#if defined(PASS_sums)
#include "lib/deposit.glsl"

layout(location = 0) out vec4 o_sums[ORDERS * PASS_GROUPS];

// What the fragment leaves in each cell.
void main() {
    Deposit deposit = deposit_or_discard();
    float means[CLUSTERS] = former_means(ivec2(gl_FragCoord.xy));
    for (int group = 0; group < PASS_GROUPS; ++group) {
        mat4x3 moments = mat4x3(0.0);
        for (int i = 0; i < 4; ++i) {
            int k = 4 * (FIRST_GROUP + group) + i;
            if (k < CLUSTERS)
                moments[i] = cell_moments(cell_of(means, k), deposit.depth, deposit.depth_end,
                                          deposit.optical_depth, means[k]);
        }
        mat3x4 sums = transpose(moments);
        for (int order = 0; order < ORDERS; ++order) o_sums[ORDERS * group + order] = sums[order];
    }
}
#elif defined(PASS_means) || defined(PASS_limits)
#include "lib/invocation.glsl"

uniform sampler2DArray t_sums;
#ifdef PASS_means
layout(rgba32f) writeonly uniform image2DArray i_means;
#else
layout(rgba32f) writeonly uniform image2DArray i_limits;
#endif

// Of a cluster that holds nothing the mean stays.
void main() {
    ivec2 size = textureSize(t_sums, 0).xy;
    int index = int(invocation_index());
    ivec2 texel = ivec2(index % size.x, index / size.x);
    if (texel.y >= size.y) return;
    float means[CLUSTERS] = former_means(texel);
    for (int group = 0; group < groups; ++group) {
        mat3x4 sums = mat3x4(0.0);
        for (int order = 0; order < ORDERS; ++order)
            sums[order] = texelFetch(t_sums, ivec3(texel, ORDERS * group + order), 0);
        mat4x3 moments = transpose(sums);
        vec4 mean = vec4(0.0), reach = vec4(0.0);
        for (int i = 0; i < 4 && 4 * group + i < CLUSTERS; ++i) {
            int k = 4 * group + i;
            Cluster cluster = cluster_of(moments[i], means[k]);
            vec2 cell = cell_of(means, k);
            mean[i] = min(max(cluster.mean, cell.x), cell.y);
            reach[i] = cluster.reach;
        }
#ifdef PASS_means
        imageStore(i_means, ivec3(texel, group), mean);
#else
        imageStore(i_limits, ivec3(texel, 3 * group), mean);
        imageStore(i_limits, ivec3(texel, 3 * group + 1), reach);
        imageStore(i_limits, ivec3(texel, 3 * group + 2), sums[0]);
#endif
    }
}
#else

#include "lib/receiver.glsl"

uniform sampler2DArray t_limits;

float texel_optical_depth(ivec2 texel, float depth, OwnDeposit own) {
    bool corrects = own.optical_depth > 0.0;
    float means[CLUSTERS];
    if (corrects) means = former_means(texel);
    float in_front = 0.0, taken_out = 0.0;
    for (int group = 0; group < groups; ++group) {
        vec4 mean = texelFetch(t_limits, ivec3(texel, 3 * group), 0);
        vec4 reach = texelFetch(t_limits, ivec3(texel, 3 * group + 1), 0);
        vec4 held = texelFetch(t_limits, ivec3(texel, 3 * group + 2), 0);
        for (int i = 0; i < 4 && 4 * group + i < CLUSTERS; ++i) {
            Cluster cluster = Cluster(mean[i], reach[i], held[i]);
            if (corrects) {
                cluster = without(cluster, cell_moments(cell_of(means, 4 * group + i), own.depth, own.depth_end,
                                                        own.optical_depth, cluster.mean));
                taken_out += held[i] - cluster.optical_depth;
            }
            in_front += optical_depth_before(depth, cluster);
        }
    }
    return in_front + min(own_in_front(own, depth), taken_out);
}

#include "lib/lookup.glsl"
#endif
