#include "rays/voxels.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace opacity::rays {
namespace {

constexpr int brick_side = 8;  // voxels
using Index = std::array<int, 3>;

// Cells first .. end - 1 along each axis, which a ray leaves at once.
struct Cells {
    Index first, end;
};

Cells brick_around(const Index& voxel, const Index& size) {
    Cells cells{};
    for (std::size_t i = 0; i < 3; ++i) {
        cells.first[i] = voxel[i] / brick_side * brick_side;
        cells.end[i] = std::min(cells.first[i] + brick_side, size[i]);
    }
    return cells;
}

// A ray from voxel to voxel. Each plane is met at a distance of its own, which no step before it
// moves: nothing adds up but optical depth.
class Walk {
   public:
    Walk(const double3& origin, const double3& direction, const Index& size)
        : origin_{origin}, direction_{direction}, size_{size} {}

    // Cut to the box of all voxels; to an empty span where it is missed.
    Span inside(Span span) const {
        for (std::size_t i = 0; i < 3; ++i) {
            if (direction_[i] == 0.0) {
                if (!(origin_[i] >= 0.0 && origin_[i] < size_[i])) return {0.0, 0.0};
                continue;
            }
            const double a = distance_to(i, 0), b = distance_to(i, size_[i]);
            span.from = std::max(span.from, std::min(a, b));
            span.to = std::min(span.to, std::max(a, b));
        }
        return span;
    }
    void start(double distance) {
        distance_ = distance;
        for (std::size_t i = 0; i < 3; ++i) voxel_[i] = std::clamp(cell(i), 0, size_[i] - 1);
    }
    const Index& voxel() const { return voxel_; }
    double distance() const { return distance_; }

    // Beyond the voxel, or beyond more cells around it. False: the ray has left the box.
    bool leave_voxel() { return leave({voxel_, {voxel_[0] + 1, voxel_[1] + 1, voxel_[2] + 1}}); }
    bool leave_brick() { return leave(brick_around(voxel_, size_)); }

   private:
    double distance_to(std::size_t axis, int plane) const {
        return (plane - origin_[axis]) / direction_[axis];
    }
    int cell(std::size_t axis) const {
        const double at = origin_[axis] + distance_ * direction_[axis];
        return int(std::floor(std::clamp(at, 0.0, double(size_[axis]))));
    }
    bool leave(const Cells& cells) {
        std::size_t through = 0;
        double nearest = std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i < 3; ++i) {
            if (direction_[i] == 0.0) continue;
            const double there =
                distance_to(i, direction_[i] > 0.0 ? cells.end[i] : cells.first[i]);
            if (there >= nearest) continue;
            nearest = there;
            through = i;
        }
        distance_ = std::max(distance_, nearest);
        for (std::size_t i = 0; i < 3; ++i)
            if (i != through && cells.end[i] - cells.first[i] > 1) advance(i, cells);
        voxel_[through] = direction_[through] > 0.0 ? cells.end[through] : cells.first[through] - 1;
        return voxel_[through] >= 0 && voxel_[through] < size_[through];
    }
    // Along an axis on which the ray stays between the planes of the cells; never back.
    void advance(std::size_t axis, const Cells& cells) {
        const int here = std::clamp(cell(axis), cells.first[axis], cells.end[axis] - 1);
        int& voxel = voxel_[axis];
        voxel = direction_[axis] > 0.0 ? std::max(voxel, here) : std::min(voxel, here);
    }

    double3 origin_, direction_;  // in voxels
    Index size_, voxel_{};
    double distance_ = 0.0;
};

}  // namespace

Voxels::Voxels(std::shared_ptr<const Volume> volume, const Frame& frame)
    : volume_{std::move(volume)} {
    const auto& [nz, ny, nx] = volume_->size_zyx();
    size_ = {nx, ny, nz};
    double3 spacing = volume_->spacing();
    for (double& side : spacing) side *= frame.scale;
    double3x3 from_voxels = linear_part(volume_->transform(), spacing);
    const double3x3 turn = linear_part(frame.rotation);
    for (std::size_t column = 0; column < 3; ++column) {
        const double3 axis =
            product(turn, {from_voxels[column], from_voxels[3 + column], from_voxels[6 + column]});
        for (std::size_t row = 0; row < 3; ++row) from_voxels[3 * row + column] = axis[row];
    }
    voxels_from_frame_ = inverse(from_voxels);
    center_ = frame.from_world(transform_point(volume_->transform(), volume_->box().center()));
    for (std::size_t i = 0; i < volume_->points().size(); ++i)
        bounds_.extend(
            frame.from_world(transform_point(volume_->transform(), volume_->points()[i])));
    find_empty_bricks();
}

void Voxels::find_empty_bricks() {
    std::size_t bricks = 1;
    for (std::size_t i = 0; i < 3; ++i) {
        brick_count_[i] = (size_[i] + brick_side - 1) / brick_side;
        bricks *= std::size_t(brick_count_[i]);
    }
    is_empty_.assign(bricks, 1);
    const float* extinction = volume_->extinction().data();
    for (int z = 0; z < size_[2]; ++z)
        for (int y = 0; y < size_[1]; ++y)
            for (int x = 0; x < size_[0]; ++x)
                if (*extinction++ > 0.f) is_empty_[brick_of({x, y, z})] = 0;
}

std::size_t Voxels::brick_of(const Index& voxel) const {
    const auto brick = [&](std::size_t axis) { return std::size_t(voxel[axis] / brick_side); };
    const std::size_t row = brick(2) * std::size_t(brick_count_[1]) + brick(1);
    return row * std::size_t(brick_count_[0]) + brick(0);
}

double Voxels::extinction(const Index& voxel) const {
    const std::size_t row = std::size_t(voxel[2]) * std::size_t(size_[1]) + std::size_t(voxel[1]);
    return volume_->extinction()[row * std::size_t(size_[0]) + std::size_t(voxel[0])];
}

double Voxels::optical_depth(const Ray& ray, const Span& span) const {
    double3 origin = ray.origin;
    for (std::size_t i = 0; i < 3; ++i) origin[i] -= center_[i];
    origin = product(voxels_from_frame_, origin);
    for (std::size_t i = 0; i < 3; ++i) origin[i] += 0.5 * size_[i];
    const double3 direction = product(voxels_from_frame_, ray.toward);

    Walk walk{origin, direction, size_};
    const Span inside = walk.inside(span);
    if (!(inside.from < inside.to)) return 0.0;
    double sum = 0.0;
    walk.start(inside.from);
    for (bool goes_on = true; goes_on && walk.distance() < inside.to;) {
        if (is_empty_[brick_of(walk.voxel())]) {
            goes_on = walk.leave_brick();
            continue;
        }
        const double from = walk.distance(), here = extinction(walk.voxel());
        goes_on = walk.leave_voxel();
        sum += here * (std::min(walk.distance(), inside.to) - from);
    }
    const double3& spacing = volume_->spacing();  // the shape's units for each unit of the frame
    return sum * std::hypot(direction[0] * spacing[0], direction[1] * spacing[1],
                            direction[2] * spacing[2]);
}

}  // namespace opacity::rays
