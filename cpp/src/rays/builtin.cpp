// A hierarchy of boxes, split where the surface area heuristic says (binned: Wald, On fast
// construction of SAH-based bounding volume hierarchies, 2007).
#include <algorithm>
#include <array>
#include <limits>

#include "rays/backend.hpp"

namespace opacity::rays {
namespace {

constexpr std::uint32_t most_in_leaf = 4;
constexpr int bin_count = 16;
// Beyond this depth nodes are halved, so that a search needs a stack of a fixed size only.
constexpr int most_depth_by_area = 48;
constexpr std::size_t stack_size = 128;
constexpr float infinity = std::numeric_limits<float>::infinity();

struct Bounds {
    std::array<float, 3> min{infinity, infinity, infinity};
    std::array<float, 3> max{-infinity, -infinity, -infinity};

    template <class Other>
    void extend(const Other& other) {
        for (std::size_t i = 0; i < 3; ++i) {
            min[i] = std::min(min[i], other.min[i]);
            max[i] = std::max(max[i], other.max[i]);
        }
    }
    float extent(std::size_t axis) const { return max[axis] - min[axis]; }
    // What rays see of it: those along the z axis, or those in all directions.
    float area(bool parallel) const {
        if (!(extent(0) >= 0.f)) return 0.f;
        const float across = extent(0) * extent(1);
        return parallel ? across : across + extent(2) * (extent(0) + extent(1));
    }
};

// Twice the middle, which sorts alike.
float center(const Piece& piece, std::size_t axis) {
    return piece.min[axis] + piece.max[axis];
}

struct Node {
    Bounds box;
    std::uint32_t first = 0;  // the left child, the right one is next to it; or a piece
    std::uint32_t count = 0;  // of pieces; 0: an inner node
};

struct Bin {
    Bounds box;
    std::uint32_t count = 0;

    void add(const Bin& other) {
        box.extend(other.box);
        count += other.count;
    }
    float cost(bool parallel) const { return box.area(parallel) * float(count); }
};

class Builtin : public Backend {
   public:
    Builtin(const Casters& casters, const Stop& stop)
        : parallel_{casters.parallel}, pieces_{pieces_of(casters)} {
        nodes_.reserve(pieces_.size());
        nodes_.emplace_back();
        build(0, 0, std::uint32_t(pieces_.size()), 0, stop);
    }

    void search(Hits& hits, const Reach& reach) const override;

   private:
    void build(std::uint32_t node, std::uint32_t first, std::uint32_t last, int depth,
               const Stop& stop);
    std::uint32_t divide(std::uint32_t first, std::uint32_t last, const Bounds& centers, int depth);

    const bool parallel_;
    std::vector<Piece> pieces_;  // those of a leaf side by side
    std::vector<Node> nodes_;
};

// Along the longest side, across the rays, of the box around the middles.
struct Binning {
    std::size_t axis = 0;
    float low = 0.f, bins_per_unit = 0.f;

    Binning(const Bounds& centers, bool parallel) {
        if (centers.extent(1) > centers.extent(0)) axis = 1;
        if (!parallel && centers.extent(2) > centers.extent(axis)) axis = 2;
        if (!(centers.extent(axis) > 0.f)) axis = 2;
        low = centers.min[axis];
        bins_per_unit = float(bin_count) / centers.extent(axis);
    }
    int operator()(const Piece& piece) const {
        return std::clamp(int((center(piece, axis) - low) * bins_per_unit), 0, bin_count - 1);
    }
};

// The last bin of the left part for which the heuristic expects least work.
int best_split(const std::array<Bin, bin_count>& bins, bool parallel) {
    std::array<float, bin_count> right{};
    Bin sum;
    for (std::size_t i = bin_count - 1; i > 0; --i) {
        sum.add(bins[i]);
        right[i - 1] = sum.cost(parallel);
    }
    std::size_t best = 0;
    float least = infinity;
    sum = {};
    for (std::size_t i = 0; i + 1 < bin_count; ++i) {
        sum.add(bins[i]);
        if (sum.cost(parallel) + right[i] >= least) continue;
        least = sum.cost(parallel) + right[i];
        best = i;
    }
    return int(best);
}

// Puts the left part of [first, last) before the right one; returns where this starts.
std::uint32_t Builtin::divide(std::uint32_t first, std::uint32_t last, const Bounds& centers,
                              int depth) {
    const std::uint32_t middle = first + (last - first) / 2;
    const Binning bin_of{centers, parallel_};
    if (!(centers.extent(bin_of.axis) > 0.f) || depth > most_depth_by_area) return middle;
    std::array<Bin, bin_count> bins;
    for (std::uint32_t i = first; i < last; ++i) {
        Bin& bin = bins[std::size_t(bin_of(pieces_[i]))];
        bin.box.extend(pieces_[i]);
        ++bin.count;
    }
    const int split = best_split(bins, parallel_);
    const auto right = std::partition(pieces_.begin() + first, pieces_.begin() + last,
                                      [&](const Piece& piece) { return bin_of(piece) <= split; });
    const auto at = std::uint32_t(right - pieces_.begin());
    return at == first || at == last ? middle : at;
}

void Builtin::build(std::uint32_t node, std::uint32_t first, std::uint32_t last, int depth,
                    const Stop& stop) {
    Bounds box, centers;
    for (std::uint32_t i = first; i < last; ++i) {
        const Piece& piece = pieces_[i];
        const std::array<float, 3> at{center(piece, 0), center(piece, 1), center(piece, 2)};
        box.extend(piece);
        centers.extend(Bounds{at, at});
    }
    nodes_[node].box = box;
    if (last - first <= most_in_leaf || stop()) {
        nodes_[node].first = first;
        nodes_[node].count = last - first;
        return;
    }
    const std::uint32_t middle = divide(first, last, centers, depth);
    const auto left = std::uint32_t(nodes_.size());
    nodes_[node].first = left;
    nodes_.resize(nodes_.size() + 2);
    build(left, first, middle, depth + 1, stop);
    build(left + 1, middle, last, depth + 1, stop);
}

// The ray against slabs. Where it runs along a face of the box, infinity times 0 gives NaN, which
// std::min and std::max pass over here; the margin makes that right.
class Slabs {
   public:
    Slabs(const Ray& ray, const Reach& reach) : length_{float(reach.length)} {
        for (std::size_t i = 0; i < 3; ++i) {
            origin_[i] = float(reach.start[i]);
            inverse_[i] = float(1.0 / ray.toward[i]);
        }
    }
    template <class Box>
    bool meet(const Box& box) const {
        float from = 0.f, to = length_;
        for (std::size_t i = 0; i < 3; ++i) {
            const float a = (box.min[i] - origin_[i]) * inverse_[i];
            const float b = (box.max[i] - origin_[i]) * inverse_[i];
            from = std::max(from, std::min(a, b));
            to = std::min(to, std::max(a, b));
        }
        return from <= to;
    }

   private:
    std::array<float, 3> origin_{}, inverse_{};
    float length_;
};

void Builtin::search(Hits& hits, const Reach& reach) const {
    const Slabs slabs{hits.ray(), reach};
    std::array<std::uint32_t, stack_size> stack;
    std::size_t size = 0;
    if (slabs.meet(nodes_[0].box)) stack[size++] = 0;
    while (size > 0) {
        const Node& node = nodes_[stack[--size]];
        if (node.count == 0) {
            for (const std::uint32_t child : {node.first, node.first + 1})
                if (slabs.meet(nodes_[child].box)) stack[size++] = child;
            continue;
        }
        for (std::uint32_t i = node.first; i < node.first + node.count; ++i)
            if (slabs.meet(pieces_[i]) && !hits.visit(pieces_[i].primitive)) return;
    }
}

}  // namespace

std::unique_ptr<Backend> build_builtin(const Casters& casters, const Stop& stop) {
    return std::make_unique<Builtin>(casters, stop);
}

}  // namespace opacity::rays
