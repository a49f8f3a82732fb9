#include "scene/split_fit.hpp"

#include <algorithm>
#include <cmath>

#include "core/vector.hpp"

namespace opacity {
namespace {

// Between a window and the edge of its map: what a bilinear look-up reads beside a receiver, half a
// texel by which the window is moved to snap, and one to spare.
constexpr double border_px = 3.0;
constexpr int least_map_size_px = 16;
// The smallest limit of textures that OpenGL 4.5 allows a driver.
constexpr int largest_texture_px = 16384;
// Room to move before a window must.
constexpr double room = 1.06;
// A window is as many times finer than the whole map as some power of 2^(1/4): else its texels
// would change their size with every look of the camera.
constexpr double steps_a_doubling = 4.0;
// Places come as float32 texels of the whole map, which then differ by a 128th of a split's.
constexpr double most_texels = 131072.0;
// Logarithmic splits begin at a distance; no nearer than these parts of the farthest.
constexpr double least_near = 1e-3, least_seen = 1e-4;

// Nothing lies in it.
constexpr LightSplit empty_split{1.0, {-1e6, -1e6}};

// In texels of the whole map.
using Rectangle = Box;

bool can_split(const LightSpace& whole, const ViewSplits& splits) {
    if (splits.count < 2 || !whole.is_parallel() || whole.map_size_px < least_map_size_px)
        return false;
    LightSpace all = whole;
    all.splits.resize(std::size_t(splits.count) + 1);
    return all.width_px() <= largest_texture_px;
}

std::vector<Hexahedron> receivers_of(const Scene& scene) {
    std::vector<Hexahedron> receivers;
    for (const ShapePtr& shape : scene.shapes()) {
        const auto lock = shape->lock();
        const Box box = shape->bounds();
        // A flat one needs sides, too.
        if (shape->receives() && !box.empty())
            receivers.push_back(corners_of(box.padded(1e-6 * box.radius())));
    }
    return receivers;
}

// What receives, as far as the camera sees it.
class SeenReceivers {
   public:
    SeenReceivers(const Scene& scene, const CameraView& view)
        : receivers_{receivers_of(scene)}, view_{view} {
        double farthest = 0.0;
        for (const Hexahedron& receiver : receivers_)
            for (const double3& corner : receiver) farthest = std::max(farthest, distance(corner));
        least_ = least_seen * farthest;
        if (!(farthest > 0.0)) return;
        Box distances;
        for_each_corner(least_, farthest, [&](const double3& p) {
            distances.extend(double3{distance(p), 0.0, 0.0});
        });
        far_ = distances.max[0];
        near_ = std::max(distances.min[0], least_near * far_);
    }

    bool is_any_seen() const { return near_ <= far_; }
    std::vector<double> cuts(const ViewSplits& splits) const {
        std::vector<double> cuts = view_cuts(near_, far_, splits);
        cuts.front() = least_;  // what is nearer still is seen, too
        return cuts;
    }
    Rectangle between(double near, double far, const double4x4& light_from_world) const {
        Rectangle seen;
        for_each_corner(near, far, [&](const double3& p) {
            seen.extend(transform_point(light_from_world, p));
        });
        return seen;
    }

   private:
    double distance(const double3& p) const {
        return -transform_point(view_.camera.view_from_world(), p)[2];
    }
    template <class Visit>
    void for_each_corner(double near, double far, Visit visit) const {
        const Hexahedron frustum = frustum_of(view_, near, far);
        for (const Hexahedron& receiver : receivers_)
            for (const double3& corner : common_corners(frustum, receiver)) visit(corner);
    }

    std::vector<Hexahedron> receivers_;
    CameraView view_;
    double least_ = 0.0, near_ = 1.0, far_ = 0.0;
};

// Beside the whole map nothing casts.
Rectangle on_map(Rectangle needed, double size_px) {
    for (std::size_t axis = 0; axis < 2; ++axis) {
        needed.min[axis] = std::max(needed.min[axis], 0.0);
        needed.max[axis] = std::min(needed.max[axis], size_px);
    }
    return needed;
}

bool is_empty(const Rectangle& r) {
    return !(r.min[0] < r.max[0]) || !(r.min[1] < r.max[1]);
}

bool holds(const LightSplit& split, const Rectangle& needed, double size_px) {
    const double3 low = split.place(needed.min), high = split.place(needed.max);
    const double free = border_px - 0.5;  // a middle is snapped by up to half a texel
    return std::min(low[0], low[1]) >= free && std::max(high[0], high[1]) <= size_px - free;
}

// Its texels lie on the same grid wherever it is.
LightSplit snapped(const Rectangle& needed, double size_px) {
    const double side = std::max(needed.max[0] - needed.min[0], needed.max[1] - needed.min[1]);
    const double finest = most_texels / size_px;
    const double wanted = std::min((size_px - 2.0 * border_px) / (room * side), finest);
    const double steps = std::floor(steps_a_doubling * std::log2(wanted));
    if (!(steps > 0.0)) return empty_split;
    const double scale = float(std::exp2(steps / steps_a_doubling));
    const double3 middle = needed.center();
    return {scale,
            {std::round(0.5 * size_px - scale * middle[0]),
             std::round(0.5 * size_px - scale * middle[1])}};
}

// The held one while it holds what is needed and is not much coarser than it could be.
LightSplit steady(const LightSplit& held, const Rectangle& needed, double size_px) {
    if (is_empty(needed)) return empty_split;
    const LightSplit best = snapped(needed, size_px);
    const double coarsest = best.scale * std::exp2(-1.5 / steps_a_doubling);
    const bool still_does = held != empty_split && best != empty_split && held.scale >= coarsest &&
                            holds(held, needed, size_px);
    return still_does ? held : best;
}

}  // namespace

std::vector<LightSplit> SplitFit::fit(const LightSpace& whole, const Scene& scene,
                                      const CameraView& view, const ViewSplits& splits) {
    const std::size_t maps = std::size_t(splits.count) + 1;
    if (!can_split(whole, splits)) return held_ = {};
    if (whole.from_world != whole_ || held_.size() != maps) held_.assign(maps, empty_split);
    whole_ = whole.from_world;
    held_[0] = {};
    const SeenReceivers receivers{scene, view};
    const bool is_any_seen = receivers.is_any_seen();
    const std::vector<double> cuts =
        is_any_seen ? receivers.cuts(splits) : std::vector<double>(maps, 1.0);
    for (std::size_t i = 1; i < maps; ++i) {
        Rectangle needed;
        if (is_any_seen) needed = receivers.between(cuts[i - 1], cuts[i], whole.from_world);
        held_[i] = steady(held_[i], on_map(needed, whole.map_size_px), whole.map_size_px);
    }
    return held_;
}

}  // namespace opacity
