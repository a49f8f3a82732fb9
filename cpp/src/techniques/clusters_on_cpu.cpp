#include "techniques/clusters_on_cpu.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <span>

#include "map/clusters.hpp"
#include "map/fragments.hpp"

namespace opacity::techniques {
namespace {

// A map of so many layers for each group of clusters.
class GroupedMap {
   public:
    GroupedMap(PassContext& context, const Texture& map, int layers_a_group)
        : values_{context.memory<float>(map)},
          texel_count_{std::size_t(map.desc().width) * map.desc().height},
          layers_{std::size_t(layers_a_group)} {}

    float& at(std::size_t texel, std::size_t cluster, std::size_t layer) const {
        const std::size_t image = cluster / clusters_per_group * layers_ + layer;
        return values_[(image * texel_count_ + texel) * clusters_per_group +
                       cluster % clusters_per_group];
    }
    std::size_t texel_count() const { return texel_count_; }
    std::size_t layers() const { return layers_; }

   private:
    std::span<float> values_;
    std::size_t texel_count_, layers_;
};

// former_means.
class FormerMeans {
   public:
    FormerMeans(PassContext& context, const ClusterMeans& means)
        : count{std::size_t(means.count)}, found_{means.found != nullptr} {
        if (found_) {
            map_.emplace(context, *means.found, 1);
            return;
        }
        start_ = context.memory<float>(*means.start);
        end_ = context.memory<float>(*means.end);
    }
    const std::size_t count;

    std::span<const float> of(std::size_t texel, std::array<float, most_clusters>& means) const {
        for (std::size_t k = 0; k < count; ++k)
            means[k] = found_ ? map_->at(texel, k, 0) : even(texel, k);
        return std::span{means}.first(count);
    }

   private:
    float even(std::size_t texel, std::size_t k) const {
        const float along = (float(k) + 0.5f) / float(count);
        return start_[texel] + (end_[texel] - start_[texel]) * along;
    }

    bool found_;
    std::optional<GroupedMap> map_;
    std::span<const float> start_, end_;
};

class ClusteredTexels : public TexelMap {
   public:
    ClusteredTexels(PassContext& context, const ClusterMeans& former, Texture& limits)
        : former_{context, former}, limits_{context, limits, limits_layers} {}

    float optical_depth(std::size_t texel, float depth, const OwnDeposit& own) const override {
        const bool corrects = own.optical_depth > 0.f;
        std::array<float, most_clusters> storage;
        std::span<const float> means;
        if (corrects) means = former_.of(texel, storage);
        float in_front = 0.f, taken_out = 0.f;
        for (std::size_t k = 0; k < former_.count; ++k) {
            Cluster cluster{limits_.at(texel, k, 0), limits_.at(texel, k, 1),
                            limits_.at(texel, k, 2)};
            if (corrects) {
                const float held = cluster.optical_depth;
                cluster = without(cluster, cell_moments(cell_of(means, k), own.depth, own.depth_end,
                                                        own.optical_depth, cluster.mean));
                taken_out += held - cluster.optical_depth;
            }
            in_front += optical_depth_before(depth, cluster);
        }
        return in_front + std::min(own_in_front(own, depth), taken_out);
    }

   private:
    FormerMeans former_;
    GroupedMap limits_;
};

}  // namespace

std::function<void(PassContext&)> sums_on_cpu(const ShadowInputs& inputs, const ClusterSums& sums,
                                              int first_group, int group_count) {
    return [=](PassContext& context) {
        const FormerMeans former{context, sums.former};
        const GroupedMap map{context, sums.map, sums.orders};
        const auto first = std::size_t(first_group * clusters_per_group);
        const auto last =
            std::min(first + std::size_t(group_count * clusters_per_group), former.count);
        for_each_fragment(inputs.fragments(context, true), [&](const Fragment& fragment) {
            std::array<float, most_clusters> storage;
            const std::span<const float> means = former.of(fragment.texel, storage);
            for (std::size_t k = first; k < last; ++k) {
                const ClusterMoments moments =
                    cell_moments(cell_of(means, k), fragment.depth, fragment.depth_end,
                                 fragment.optical_depth, means[k]);
                if (!(moments.optical_depth > 0.f)) continue;
                map.at(fragment.texel, k, 0) += moments.optical_depth;
                map.at(fragment.texel, k, 1) += moments.first;
                if (map.layers() > 2) map.at(fragment.texel, k, 2) += moments.second;
            }
        });
    };
}

std::function<void(PassContext&)> clusters_on_cpu(const ClusterSums& sums, Texture& found) {
    return [=, &found](PassContext& context) {
        const FormerMeans former{context, sums.former};
        const GroupedMap moments{context, sums.map, sums.orders};
        const int groups = cluster_groups(sums.former.count);
        const GroupedMap clusters{context, found, found.desc().layers / groups};
        parallel_for(moments.texel_count(), [&](std::size_t texel) {
            std::array<float, most_clusters> storage;
            const std::span<const float> means = former.of(texel, storage);
            for (std::size_t k = 0; k < means.size(); ++k) {
                const float second = moments.layers() > 2 ? moments.at(texel, k, 2) : 0.f;
                const float held = moments.at(texel, k, 0);
                const Cluster cluster =
                    cluster_of({held, moments.at(texel, k, 1), second}, means[k]);
                const Cell cell = cell_of(means, k);
                clusters.at(texel, k, 0) = std::min(std::max(cluster.mean, cell.begin), cell.end);
                if (clusters.layers() < limits_layers) continue;
                clusters.at(texel, k, 1) = cluster.reach;
                clusters.at(texel, k, 2) = held;
            }
        });
    };
}

std::function<std::unique_ptr<TexelMap>(PassContext&)> clusters_look_up(const ClusterMeans& former,
                                                                        Texture& limits) {
    return [=, &limits](PassContext& context) {
        return std::make_unique<ClusteredTexels>(context, former, limits);
    };
}

}  // namespace opacity::techniques
