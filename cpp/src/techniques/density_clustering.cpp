#include "techniques/density_clustering.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "techniques/depth_bounds.hpp"
#include "techniques/drawn_layers.hpp"

namespace opacity::techniques {
namespace {

constexpr int of_means = 2, of_layers = 3;  // moments

Reads reads_of(const ClusterMeans& means, Reads more = {}) {
    if (means.found)
        more.push_back(means.found);
    else
        more.insert(more.end(), {means.start, means.end});
    return more;
}

Defines defines_of(const std::string& pass, const ClusterMeans& former, int orders) {
    Defines defines{{"PASS_" + pass, "1"},
                    {"CLUSTERS", std::to_string(former.count)},
                    {"ORDERS", std::to_string(orders)}};
    if (!former.found) defines.emplace_back("EVEN_MEANS", "1");
    return defines;
}

}  // namespace

LookUp DensityClustering::build(FrameGraph& graph, const ShadowInputs& inputs) {
    const int count = clusters.get(), groups = cluster_groups(count);
    ClusterMeans means{count, &add_first_depth(graph, inputs), &add_last_depth(graph, inputs)};
    for (int i = 1; i <= iterations.get(); ++i) {
        const FrameGraph::Scope scope{graph, "iteration" + std::to_string(i)};
        const ClusterSums sums{add_sums(graph, inputs, means, of_means), of_means, means};
        Texture& moved = graph.texture("means", inputs.map(Format::rgba32f, groups));
        add_found(graph, inputs, sums, moved);
        means.found = &moved;
    }
    const ClusterSums sums{add_sums(graph, inputs, means, of_layers), of_layers, means};
    Texture& limits = graph.texture("limits", inputs.map(Format::rgba32f, limits_layers * groups));
    add_found(graph, inputs, sums, limits);
    LookUp result = look_up(inputs, reads_of(means, {&limits}), clusters_look_up(means, limits));
    for (auto& define : defines_of("look_up", means, of_layers))
        result.defines.push_back(std::move(define));
    result.own_correction = corrects(inputs);
    return result;
}

Texture& DensityClustering::add_sums(FrameGraph& graph, const ShadowInputs& inputs,
                                     const ClusterMeans& former, int orders) const {
    const int groups = cluster_groups(former.count), most = targets_per_pass / orders;
    Texture& sums = graph.texture("sums", inputs.map(Format::rgba32f, orders * groups));
    for (int first = 0; first < groups; first += most) {
        const int here = std::min(most, groups - first);
        std::vector<Target> writes;
        for (int layer = orders * first; layer < orders * (first + here); ++layer)
            writes.emplace_back(&sums, layer);
        Defines pass_defines = defines_of("sums", former, orders);
        pass_defines.insert(pass_defines.end(), {{"FIRST_GROUP", std::to_string(first)},
                                                 {"PASS_GROUPS", std::to_string(here)}});
        graph.add({.name = first == 0 ? "sums" : "sums_" + std::to_string(first / most + 1),
                   .shader = inputs.caster_shader(shader_path(), true, std::move(pass_defines)),
                   .draws = &inputs.translucent,
                   .view = &inputs.light,
                   .reads = inputs.caster_reads(true, reads_of(former)),
                   .writes = std::move(writes),
                   .state = {.blend = Blend::add},
                   .on_cpu = sums_on_cpu(inputs, {sums, orders, former}, first, here)});
    }
    return sums;
}

void DensityClustering::add_found(FrameGraph& graph, const ShadowInputs& inputs,
                                  const ClusterSums& sums, Texture& found) const {
    const std::string name = found.shader_name();
    graph.add({.name = name,
               .shader = {.compute = shader_path(),
                          .defines = defines_of(name, sums.former, sums.orders)},
               .only_with = &inputs.translucent,
               .reads = reads_of(sums.former, {&sums.map}),
               .stores = {&found},
               .execute =
                   [&found](PassContext& context) {
                       context.dispatch(found.desc().width * found.desc().height);
                   },
               .on_cpu = clusters_on_cpu(sums, found)});
}

}  // namespace opacity::techniques
