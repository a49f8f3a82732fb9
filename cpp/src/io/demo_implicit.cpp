#include "io/demo_implicit.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace opacity::demo {
namespace {

glm::dvec3 gradient(const Field& field, const glm::dvec3& p, double step) {
    glm::dvec3 result;
    for (int axis = 0; axis < 3; ++axis) {
        glm::dvec3 d{0.0};
        d[axis] = step;
        result[axis] = (field(p + d) - field(p - d)) / (2.0 * step);
    }
    return result;
}

class Nets {
   public:
    Nets(Triangles& mesh, const Field& field, const glm::dvec3& low, const glm::dvec3& high,
         double cell)
        : mesh_{mesh}, field_{field}, low_{low}, cell_{cell}, size_{(high - low) / cell + 2.0} {
        values_.reserve(corner(size_ - 1) + 1);
        for (int z = 0; z < size_.z; ++z)
            for (int y = 0; y < size_.y; ++y)
                for (int x = 0; x < size_.x; ++x) values_.push_back(field(place({x, y, z})));
        points_.resize(values_.size());
    }

    void add() {
        each([&](const glm::ivec3& at) { add_point(at); });
        each([&](const glm::ivec3& at) {
            for (int axis = 0; axis < 3; ++axis) add_quad(at, axis);
        });
    }

   private:
    std::size_t corner(const glm::ivec3& at) const {
        return (std::size_t(at.z) * std::size_t(size_.y) + std::size_t(at.y)) *
                   std::size_t(size_.x) +
               std::size_t(at.x);
    }
    bool inside(const glm::ivec3& at) const { return values_[corner(at)] < 0.0; }
    glm::dvec3 place(const glm::ivec3& at) const { return low_ + cell_ * glm::dvec3{at}; }

    template <class Work>
    void each(const Work& work) const {
        for (int z = 0; z + 1 < size_.z; ++z)
            for (int y = 0; y + 1 < size_.y; ++y)
                for (int x = 0; x + 1 < size_.x; ++x) work(glm::ivec3{x, y, z});
    }

    void add_point(const glm::ivec3& at) {
        int corners_inside = 0;
        for (int i = 0; i < 8; ++i)
            corners_inside += inside(at + glm::ivec3{i & 1, i >> 1 & 1, i >> 2});
        if (corners_inside == 0 || corners_inside == 8) return;
        glm::dvec3 p = place(at) + 0.5 * cell_;
        for (int round = 0; round < 4; ++round) {
            const glm::dvec3 slope = gradient(field_, p, 0.1 * cell_);
            p -= field_(p) / std::max(glm::dot(slope, slope), 0.05) * slope;
            p = glm::clamp(p, place(at) - 0.3 * cell_, place(at) + 1.3 * cell_);
        }
        points_[corner(at)] = mesh_.add(p);
    }

    // Around the edge from this corner along an axis, seen from outside counter-clockwise.
    void add_quad(const glm::ivec3& at, int axis) {
        glm::ivec3 along{0}, u{0}, v{0};
        along[axis] = u[(axis + 1) % 3] = v[(axis + 2) % 3] = 1;
        const bool here = inside(at);
        if (here == inside(at + along)) return;
        const auto point = [&](const glm::ivec3& cell) { return points_[corner(cell)]; };
        if (here)
            mesh_.quad(point(at - u - v), point(at - v), point(at), point(at - u));
        else
            mesh_.quad(point(at - u - v), point(at - u), point(at), point(at - v));
    }

    Triangles& mesh_;
    const Field& field_;
    glm::dvec3 low_;
    double cell_;
    glm::ivec3 size_;
    std::vector<double> values_;
    std::vector<std::uint32_t> points_;
};

}  // namespace

double ellipsoid_distance(const glm::dvec3& from_center, const glm::dvec3& half_axes) {
    const glm::dvec3 scaled = from_center / half_axes;
    const double gauge = glm::length(scaled), slope = glm::length(scaled / half_axes);
    if (slope < 1e-9) return -std::min({half_axes.x, half_axes.y, half_axes.z});
    return gauge * (gauge - 1.0) / slope;
}

double smooth_union(double a, double b, double reach) {
    const double overlap = std::max(reach - std::abs(a - b), 0.0) / reach;
    return std::min(a, b) - 0.25 * reach * overlap * overlap;
}

void add_surface(Triangles& mesh, const Field& field, const glm::dvec3& low, const glm::dvec3& high,
                 double cell) {
    Nets{mesh, field, low, high, cell}.add();
}

}  // namespace opacity::demo
