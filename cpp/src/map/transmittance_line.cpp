#include "map/transmittance_line.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace opacity {
namespace {

constexpr float least_chord_error = 1e-4f;

using Nodes = std::vector<TransmittanceNode>;

// Of all nodes but the first and last, the one whose triangle with its neighbours is least.
std::size_t least_node(const Nodes& nodes) {
    std::size_t least = 0;
    float least_area = 1e30f;
    for (std::size_t i = 1; i + 1 < nodes.size(); ++i) {
        const auto [z0, t0] = nodes[i - 1];
        const auto [z1, t1] = nodes[i];
        const auto [z2, t2] = nodes[i + 1];
        const float area = std::abs((z2 - z0) * (t2 - t1) - (z2 - z1) * (t2 - t0));
        if (area < least_area) least = i, least_area = area;
    }
    return least;
}

// From the last node on, the slopes whose line passes all vertices since then within the bound.
class Line {
   public:
    Line(Nodes& nodes, int most_nodes) : nodes_{nodes}, most_nodes_{std::size_t(most_nodes)} {}

    void start(float depth, float transmittance) {
        node_ = {depth, transmittance};
        steepest_ = -1e30f, flattest_ = 0.f;
        depth_ = depth, low_ = high_ = transmittance;
    }
    void add_vertex(float depth, float transmittance, float low, float high) {
        if (depth > node_.depth && !extend(depth, low, high)) {
            end();
            if (depth > node_.depth) extend(depth, low, high);
        }
        if (!(depth > node_.depth) && node_.transmittance > high) add_node(depth, transmittance);
    }
    void end() {
        if (!(depth_ > node_.depth)) return;
        const float slope = 0.5f * (steepest_ + flattest_);
        const float there = node_.transmittance + slope * (depth_ - node_.depth);
        add_node(depth_, std::max(low_, std::min(there, high_)));
    }

   private:
    bool extend(float depth, float low, float high) {
        const float run = depth - node_.depth;
        const float steepest =
            std::max(steepest_, std::min((low - node_.transmittance) / run, 0.f));
        const float flattest = std::min(flattest_, (high - node_.transmittance) / run);
        if (steepest > flattest) return false;
        const bool again = depth == depth_;  // a step: both of its sides count
        low_ = again ? std::max(low_, low) : low;
        high_ = again ? std::min(high_, high) : high;
        steepest_ = steepest, flattest_ = flattest, depth_ = depth;
        return true;
    }
    void add_node(float depth, float transmittance) {
        if (nodes_.empty() && depth > node_.depth) keep(node_);
        keep({depth, transmittance});
        start(depth, transmittance);
    }
    void keep(const TransmittanceNode& node) {
        nodes_.push_back(node);
        if (most_nodes_ > 0 && nodes_.size() > most_nodes_)
            nodes_.erase(nodes_.begin() + std::ptrdiff_t(least_node(nodes_)));
    }

    Nodes& nodes_;
    std::size_t most_nodes_;
    TransmittanceNode node_{};
    float steepest_ = 0.f, flattest_ = 0.f;
    float depth_ = 0.f, low_ = 0.f, high_ = 0.f;
};

// One part of a list, which begins and ends exactly where T does.
class Compressor {
   public:
    Compressor(Nodes& nodes, const Compression& compression)
        : line_{nodes, compression.most_nodes},
          error_bound_{compression.error_bound},
          chord_error_{std::max(0.25f * compression.error_bound, least_chord_error)} {}

    void compress(ListEntry last, std::span<const ListEntry> part) {
        lowest_ = std::exp(-part.back().optical_depth);
        line_.start(last.depth, std::exp(-last.optical_depth));
        for (const ListEntry& here : part) {
            if (here.depth > last.depth) add_ramp(last, here.depth);
            last = here;
        }
        line_.add_vertex(last.depth, lowest_, lowest_, lowest_);
        line_.end();
    }

   private:
    void add_depth(float depth, float optical_depth, bool is_on_chord) {
        const float transmittance = std::exp(-optical_depth);
        const float above = is_on_chord ? std::max(error_bound_ - chord_error_, 0.f) : error_bound_;
        const float low = std::min(std::max(transmittance - error_bound_, lowest_), transmittance);
        line_.add_vertex(depth, transmittance, low, transmittance + above);
    }
    void add_ramp(const ListEntry& entry, float depth) {
        const bool is_interval = entry.density > 0.f;
        add_depth(entry.depth, entry.optical_depth, is_interval);
        const float end = entry.optical_depth_at(depth), step = std::sqrt(8.f * chord_error_);
        const auto next = [&](float reached) { return reached + step * std::exp(0.5f * reached); };
        for (float reached = next(entry.optical_depth); reached < end; reached = next(reached)) {
            const float there = entry.depth + (reached - entry.optical_depth) / entry.density;
            add_depth(std::min(there, depth), reached, true);
        }
        add_depth(depth, end, is_interval);
    }

    Line line_;
    float error_bound_, chord_error_;
    float lowest_ = 0.f;
};

}  // namespace

std::vector<TransmittanceNode> compressed(std::span<const ListEntry> list,
                                          const Compression& compression) {
    Nodes nodes;
    Compressor compressor{nodes, compression};
    const std::size_t part = std::size_t(compression.part);
    for (std::size_t begin = 0; begin < list.size(); begin += part) {
        const ListEntry last =
            begin == 0 ? ListEntry{list.front().depth, 0.f, 0.f, 0} : list[begin - 1];
        compressor.compress(last, list.subspan(begin, std::min(part, list.size() - begin)));
    }
    return nodes;
}

float transmittance_at(std::span<const TransmittanceNode> nodes, float depth) {
    const auto behind =
        std::lower_bound(nodes.begin(), nodes.end(), depth,
                         [](const TransmittanceNode& node, float z) { return node.depth < z; });
    if (behind == nodes.begin()) return 1.f;
    const TransmittanceNode& before = *(behind - 1);
    if (behind == nodes.end()) return before.transmittance;
    const float part = (depth - before.depth) / (behind->depth - before.depth);
    return before.transmittance * (1.f - part) + behind->transmittance * part;
}

}  // namespace opacity
