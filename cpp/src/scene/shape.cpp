#include "opacity/scene/shape.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <string>
#include <utility>
#include <variant>

#include "core/number_text.hpp"
#include "opacity/core/error.hpp"
#include "scene/check.hpp"
#include "scene/primitive_chunks.hpp"

namespace opacity {
namespace {

// Vertices are indexed by 32 bits on the GPU.
constexpr std::size_t max_points = std::numeric_limits<std::uint32_t>::max();

std::string point_text(const double3& p) {
    return "(" + number_text(p[0]) + ", " + number_text(p[1]) + ", " + number_text(p[2]) + ")";
}

void check_points(const Positions& points) {
    const std::size_t numbers = points.visit([](const auto& xyz) { return xyz.size(); });
    if (numbers % 3 != 0)
        throw ParameterError("points holds " + std::to_string(numbers) + " numbers",
                             "pass three a point: x0 y0 z0 x1 ...");
    if (points.size() > max_points)
        throw ParameterError("points holds " + std::to_string(points.size()) + " points",
                             "split the shape: one holds at most " + std::to_string(max_points));
    const std::size_t bad = points.first_bad();
    if (bad < points.size())
        throw ParameterError(
            "points[" + std::to_string(bad) + "] = " + point_text(points[bad]) +
                " is not finite, or larger than 1e18",
            "remove or repair the point; convert huge coordinates to larger units");
}

glm::dmat3 linear_part(const double4x4& m) {
    return {m[0], m[4], m[8], m[1], m[5], m[9], m[2], m[6], m[10]};  // GLM takes columns
}

// Volume of the transformed unit cube, as a part of what edges so long could span: independent of
// units, so that a scale of 1e-6 counts as invertible and a flattened shape does not.
double relative_volume(const double4x4& transform) {
    glm::dmat3 m = linear_part(transform);
    for (int column = 0; column < 3; ++column) {
        const double length = glm::length(m[column]);
        if (length == 0.0) return 0.0;
        m[column] /= length;
    }
    return std::abs(glm::determinant(m));
}

void check_transform(const double4x4& m) {
    const Allowed element{-max_coordinate, max_coordinate, "finite and at most 1e18 in size"};
    for (std::size_t i = 0; i < m.size(); ++i)
        check_value(
            ("transform[" + std::to_string(i / 4) + "][" + std::to_string(i % 4) + "]").c_str(),
            m[i], element);
    if (m[12] != 0.0 || m[13] != 0.0 || m[14] != 0.0 || m[15] != 1.0)
        throw ParameterError("the transform's last row is not 0 0 0 1",
                             "pass an affine matrix by rows, the translation in the last column");
    if (relative_volume(m) < 1e-12)
        throw ParameterError("the transform is not invertible: it flattens the shape",
                             "give every axis a scale other than 0, and no two axes one direction");
}

}  // namespace

Shape::Shape(Positions points, std::vector<float> opacity, std::vector<float3> color)
    : points_{std::move(points)}, chunks_{std::make_shared<ChunkSlot>()} {
    check_points(points_);
    point_bounds_ = points_.bounds();
    assign_opacity(std::move(opacity));
    check_attribute_size("color", color.size());
    check_values("color", flat(color), brightness, 3);
    color_ = std::move(color);
}

Shape::Shape(const Shape& other)
    : points_{other.points_},
      point_bounds_{other.point_bounds_},
      revisions_{.geometry = other.revisions_.geometry,
                 .opacity = other.revisions_.opacity,
                 .color = other.revisions_.color},
      tint_{other.tint_},
      min_opacity_{other.min_opacity_},
      max_opacity_{other.max_opacity_},
      opacity_{other.opacity_},
      color_{other.color_},
      transform_{other.transform_},
      casts_{other.casts_},
      receives_{other.receives_},
      chunks_{other.chunks_} {}

ShapePtr Shape::instance() const {
    const auto held = lock();
    return clone();
}

ShapePtr Shape::in_channel(std::size_t channel) const {
    const auto held = lock();
    ShapePtr shape = clone();
    shape->revisions_ = revisions_;
    if (tint_) shape->show(tint_->channels.at(channel));
    shape->tint_ = nullptr;
    return shape;
}

void Shape::show(const Tint::Channel& channel) {
    opacity_ = channel.values;
    find_extremes();
    revisions_.opacity = channel.revision;
}

// One that moves its points leaves the others theirs.
std::shared_ptr<const PrimitiveChunks> Shape::chunks() const {
    std::shared_ptr<const PrimitiveChunks> found;
    {
        const std::lock_guard held{chunks_->mutex};
        if (!chunks_->chunks)
            chunks_->chunks = std::make_shared<const PrimitiveChunks>(chunks_of(*this, nullptr));
        found = chunks_->chunks;
    }
    if (found->geometry == revisions_.geometry) return found;
    chunks_ = std::make_shared<ChunkSlot>();
    return chunks_->chunks = std::make_shared<const PrimitiveChunks>(chunks_of(*this, found.get()));
}

void Shape::check_attribute_size(const char* name, std::size_t size) const {
    if (size == 1 || size == points_.size()) return;
    throw ParameterError(std::string{name} + " has " + std::to_string(size) + " entries for " +
                             std::to_string(points_.size()) + " points",
                         "pass one for all, or one a point");
}

void Shape::set_points(Positions points) {
    check_points_are_settable();
    check_points(points);
    const auto held = lock();
    if (points.size() != points_.size())
        throw ParameterError(std::to_string(points.size()) + " points for a shape of " +
                                 std::to_string(points_.size()),
                             "pass as many as there are; make a new shape for another number");
    points_ = std::move(points);
    point_bounds_ = points_.bounds();
    points_changed();
    revisions_.geometry = next_revision();
}

void Shape::assign_opacity(std::vector<float> opacity) {
    check_attribute_size("opacity", opacity.size());
    check_values("opacity", opacity, unit_interval);
    opacity_ = std::move(opacity);
    find_extremes();
}

void Shape::find_extremes() {
    const auto [low, high] = std::minmax_element(opacity_->begin(), opacity_->end());
    min_opacity_ = opacity_->empty() ? 0.f : *low;
    max_opacity_ = opacity_->empty() ? 0.f : *high;
}

void Shape::set_opacity(std::vector<float> opacity) {
    const auto held = lock();
    assign_opacity(std::move(opacity));
    tint_ = nullptr;
    revisions_.opacity = next_revision();
}

void Shape::set_opacity_rgb(const std::vector<float3>& rgb) {
    check_values("opacity", flat(rgb), unit_interval, 3);
    const auto held = lock();
    auto tint = std::make_shared<const Tint>(rgb, tint_.get());
    assign_opacity(tint->mean());
    tint_ = std::move(tint);
    revisions_.opacity = next_revision();
}

void Shape::set_color(std::vector<float3> color) {
    check_values("color", flat(color), brightness, 3);
    const auto held = lock();
    check_attribute_size("color", color.size());
    color_ = std::move(color);
    revisions_.color = next_revision();
}

void Shape::set_transform(const double4x4& transform) {
    check_transform(transform);
    const auto held = lock();
    if (transform == transform_) return;
    transform_ = transform;
    revisions_.transform = next_revision();
}

double Shape::scale() const {
    return std::cbrt(std::abs(glm::determinant(linear_part(transform_))));
}

void Shape::set_casts(bool casts) {
    const auto held = lock();
    if (std::exchange(casts_, casts) != casts) revisions_.flags = next_revision();
}

void Shape::set_receives(bool receives) {
    const auto held = lock();
    if (std::exchange(receives_, receives) != receives) revisions_.flags = next_revision();
}

bool Shape::invisible_to_light() const {
    return max_opacity_ == 0.f;
}

}  // namespace opacity
