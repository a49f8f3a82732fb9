// A hierarchy of boxes, split where the surface area heuristic says (binned: Wald, On fast
// construction of SAH-based bounding volume hierarchies, 2007).
#include <algorithm>
#include <array>
#include <numeric>

#include "rays/backend.hpp"

namespace opacity::rays {
namespace {

constexpr std::uint32_t most_in_leaf = 4;
constexpr int bin_count = 16;
// Beyond this depth nodes are halved, so that a search needs a stack of a fixed size only.
constexpr int most_depth_by_area = 48;
constexpr std::size_t stack_size = 128;

struct FloatBox {
    std::array<float, 3> min, max;
};

struct Node {
    FloatBox box;
    std::uint32_t first = 0;  // the left child, the right one is next to it; or into the order
    std::uint32_t count = 0;  // of primitives; 0: an inner node
};

// The margin is more than what rounding to float32 may take away.
FloatBox rounded(const Box& box) {
    FloatBox result{};
    for (std::size_t i = 0; i < 3; ++i) {
        result.min[i] = float(box.min[i] - box_margin);
        result.max[i] = float(box.max[i] + box_margin);
    }
    return result;
}

double half_area(const Box& box) {
    if (box.empty()) return 0.0;
    const double x = box.max[0] - box.min[0], y = box.max[1] - box.min[1],
                 z = box.max[2] - box.min[2];
    return x * y + y * z + z * x;
}

struct Bin {
    Box box;
    std::uint32_t count = 0;

    void add(const Bin& other) {
        box.extend(other.box);
        count += other.count;
    }
    double cost() const { return half_area(box) * count; }
};

class Builtin : public Backend {
   public:
    Builtin(const Casters& casters, const Stop& stop) : stop_{stop} {
        const std::uint32_t count = casters.primitive_count();
        boxes_.reserve(count);
        for (std::uint32_t i = 0; i < count; ++i) boxes_.push_back(casters.bounds_of(i));
        order_.resize(count);
        std::iota(order_.begin(), order_.end(), 0u);
        nodes_.reserve(2 * std::size_t(count));
        nodes_.emplace_back();
        build(0, 0, count, 0);
        boxes_ = {};
    }

    void search(Hits& hits, const Reach& reach) const override;

   private:
    void build(std::uint32_t node, std::uint32_t first, std::uint32_t last, int depth);
    std::uint32_t divide(std::uint32_t first, std::uint32_t last, const Box& centers, int depth);

    const Stop& stop_;
    std::vector<Box> boxes_;  // while it is built
    std::vector<std::uint32_t> order_;
    std::vector<Node> nodes_;
};

int bin_of(const Box& box, const Box& centers, int axis) {
    const double low = centers.min[axis], extent = centers.max[axis] - low;
    const double at = (box.center()[axis] - low) / extent;
    return std::clamp(int(at * bin_count), 0, bin_count - 1);
}

// The last bin of the left part for which the heuristic expects least work.
int best_split(const std::array<Bin, bin_count>& bins) {
    std::array<double, bin_count> right{};
    Bin sum;
    for (int i = bin_count - 1; i > 0; --i) {
        sum.add(bins[std::size_t(i)]);
        right[std::size_t(i - 1)] = sum.cost();
    }
    int best = 0;
    double least = Box::infinity;
    sum = {};
    for (int i = 0; i + 1 < bin_count; ++i) {
        sum.add(bins[std::size_t(i)]);
        const double cost = sum.cost() + right[std::size_t(i)];
        if (cost >= least) continue;
        least = cost;
        best = i;
    }
    return best;
}

// Puts the left part of [first, last) before the right one; returns where this starts.
std::uint32_t Builtin::divide(std::uint32_t first, std::uint32_t last, const Box& centers,
                              int depth) {
    int axis = 0;
    for (int i = 1; i < 3; ++i)
        if (centers.max[i] - centers.min[i] > centers.max[axis] - centers.min[axis]) axis = i;
    const std::uint32_t middle = first + (last - first) / 2;
    if (!(centers.max[axis] > centers.min[axis]) || depth > most_depth_by_area) return middle;
    std::array<Bin, bin_count> bins;
    for (std::uint32_t i = first; i < last; ++i) {
        const Box& box = boxes_[order_[i]];
        bins[std::size_t(bin_of(box, centers, axis))].add({box, 1});
    }
    const int split = best_split(bins);
    const auto right =
        std::partition(order_.begin() + first, order_.begin() + last,
                       [&](std::uint32_t i) { return bin_of(boxes_[i], centers, axis) <= split; });
    const auto at = std::uint32_t(right - order_.begin());
    return at == first || at == last ? middle : at;
}

void Builtin::build(std::uint32_t node, std::uint32_t first, std::uint32_t last, int depth) {
    Box box, centers;
    for (std::uint32_t i = first; i < last; ++i) {
        box.extend(boxes_[order_[i]]);
        centers.extend(boxes_[order_[i]].center());
    }
    nodes_[node].box = rounded(box);
    if (last - first <= most_in_leaf || stop_()) {
        nodes_[node].first = first;
        nodes_[node].count = last - first;
        return;
    }
    const std::uint32_t middle = divide(first, last, centers, depth);
    const auto left = std::uint32_t(nodes_.size());
    nodes_[node].first = left;
    nodes_.resize(nodes_.size() + 2);
    build(left, first, middle, depth + 1);
    build(left + 1, middle, last, depth + 1);
}

// The ray against slabs. Where it runs along a face of the box, infinity times 0 gives NaN, which
// std::min and std::max pass over here; the margin makes that right.
class Slabs {
   public:
    Slabs(const Ray& ray, const Reach& reach) : origin_{ray.origin}, reach_{reach} {
        for (std::size_t i = 0; i < 3; ++i) inverse_[i] = 1.0 / ray.toward[i];
    }
    bool meet(const FloatBox& box) const {
        double from = reach_.from, to = reach_.to;
        for (std::size_t i = 0; i < 3; ++i) {
            const double a = (box.min[i] - origin_[i]) * inverse_[i];
            const double b = (box.max[i] - origin_[i]) * inverse_[i];
            from = std::max(from, std::min(a, b));
            to = std::min(to, std::max(a, b));
        }
        return from <= to;
    }

   private:
    double3 origin_, inverse_{};
    Reach reach_;
};

void Builtin::search(Hits& hits, const Reach& reach) const {
    const Slabs slabs{hits.ray(), reach};
    std::array<std::uint32_t, stack_size> stack;
    std::size_t size = 0;
    stack[size++] = 0;
    while (size > 0) {
        const Node& node = nodes_[stack[--size]];
        if (!slabs.meet(node.box)) continue;
        if (node.count == 0) {
            stack[size++] = node.first;
            stack[size++] = node.first + 1;
            continue;
        }
        for (std::uint32_t i = node.first; i < node.first + node.count; ++i)
            if (!hits.visit(order_[i])) return;
    }
}

}  // namespace

std::unique_ptr<Backend> build_builtin(const Casters& casters, const Stop& stop) {
    return std::make_unique<Builtin>(casters, stop);
}

}  // namespace opacity::rays
