#include "techniques/caster_sizes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/opacity.hpp"
#include "opacity/scene/mesh.hpp"
#include "opacity/scene/particles.hpp"
#include "opacity/scene/strands.hpp"
#include "opacity/scene/volume.hpp"
#include "scene/strand_ranks.hpp"

namespace opacity::techniques {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

// World units.
double longest_segment(const Strands& strands) {
    const double4x4& m = strands.transform();
    const auto squared = [&](const auto& xyz) {
        double most = 0.0;
        for (const std::size_t first : strands.segments()) {
            double along[3], length_squared = 0.0;
            for (std::size_t i = 0; i < 3; ++i)
                along[i] = double(xyz[3 * first + 3 + i]) - double(xyz[3 * first + i]);
            for (std::size_t row = 0; row < 12; row += 4) {
                const double moved =
                    m[row] * along[0] + m[row + 1] * along[1] + m[row + 2] * along[2];
                length_squared += moved * moved;
            }
            most = std::max(most, length_squared);
        }
        return most;
    };
    return std::sqrt(std::visit(squared, strands.points().xyz()));
}

CasterSize caster_size(const Shape& shape) {
    const double width = 2.0 * shape.margin() * shape.scale();
    if (const auto* strands = dynamic_cast<const Strands*>(&shape))
        return {longest_segment(*strands), width};
    if (dynamic_cast<const Particles*>(&shape)) return {width, width};
    return {};
}

std::size_t caster_count(const Shape& shape) {
    if (const auto* strands = dynamic_cast<const Strands*>(&shape))
        return strands->segments().size();
    if (const auto* mesh = dynamic_cast<const Mesh*>(&shape)) return mesh->triangles().size() / 3;
    return shape.points().size();
}

double distance(const Box& box, const double3& p) {
    double squared = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
        const double beside = std::max({box.min[i] - p[i], p[i] - box.max[i], 0.0});
        squared += beside * beside;
    }
    return std::sqrt(squared);
}

// Texels for each radian where a picture is stretched most, `beyond` the corners of the face;
// infinite where that is nearly beside it.
double texels_a_radian(const LightFace& face, int size_px, double beyond) {
    constexpr double most_angle = 1.5;
    double slope_squared = 0.0;
    for (const double middle : face.middle_px) {
        const double reach = std::max(std::abs(middle), std::abs(size_px - middle)) / face.focal_px;
        slope_squared += reach * reach;
    }
    const double angle = std::atan(std::sqrt(slope_squared)) + beyond;
    return angle < most_angle ? face.focal_px / std::pow(std::cos(angle), 2.0) : infinite;
}

// At most so many texels for a world unit of a caster of this size, anywhere in the box.
double texels_a_unit(double size, const Box& bounds, const LightSpace& space) {
    if (space.is_parallel()) {
        double finest = 1.0;
        for (const LightSplit& split : space.splits) finest = std::max(finest, split.scale);
        return finest * space.texels_per_unit;
    }
    const Box box = bounds.transformed(space.from_world);  // in depth ranges
    double most = 0.0;
    for (const LightFace& face : space.faces) {
        const double3 r = face.turned_back(face.offset);
        const double away = distance(box, {-r[0], -r[1], -r[2]}) * space.depth_range;
        if (!(away > 0.0)) return infinite;
        // Seen under an angle of 2 asin(size / 2 away) at most.
        const double radians_a_unit = 0.5 * std::numbers::pi / away;
        most = std::max(
            most, radians_a_unit * texels_a_radian(face, space.map_size_px, radians_a_unit * size));
    }
    return most;
}

}  // namespace

std::vector<CasterSize> caster_sizes(const DrawList& casters) {
    std::vector<CasterSize> sizes;
    for (const ShapePtr& shape : casters.shapes()) {
        const auto lock = shape->lock();
        sizes.push_back(caster_size(*shape));
    }
    return sizes;
}

double most_texels(const CasterSize& size, const Shape& shape, const LightSpace& space) {
    if (std::isinf(size.length)) return infinite;
    const double width = size.width * widening_of(shape, space.strand_detail);
    const double scale = texels_a_unit(size.length + width, shape.bounds(), space);
    // Texels that are touched, of a ribbon across an axis that it may cross at 45 degrees.
    return (scale * size.length + 2.0) * (scale * std::numbers::sqrt2 * width + 2.0);
}

std::size_t small_caster_count(const DrawList& casters, double strand_detail) {
    std::size_t count = 0;
    for (const ShapePtr& shape : casters.shapes()) {
        const auto lock = shape->lock();
        const bool is_surface = dynamic_cast<const Mesh*>(shape.get());
        if (is_surface || dynamic_cast<const Volume*>(shape.get())) continue;
        count += std::size_t(double(caster_count(*shape)) / widening_of(*shape, strand_detail));
    }
    return count;
}

double most_optical_depth(const DrawList& casters) {
    double sum = 0.0;
    for (const ShapePtr& shape : casters.shapes()) {
        const auto lock = shape->lock();
        if (dynamic_cast<const Volume*>(shape.get())) return infinite;
        const std::vector<float>& opacity = shape->opacity();
        const double most = *std::max_element(opacity.begin(), opacity.end());
        sum += double(caster_count(*shape)) * optical_depth_of(most);
    }
    return sum;
}

}  // namespace opacity::techniques
