#include "opacity/scene/mesh.hpp"

#include <algorithm>
#include <array>
#include <glm/glm.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <string>

#include "opacity/core/error.hpp"
#include "scene/check.hpp"

namespace opacity {
namespace {

constexpr std::array<const char*, 3> alpha_mode_names{"opaque", "mask", "blend"};

void check_triangles(const std::vector<std::uint32_t>& triangles, std::size_t points) {
    if (triangles.size() % 3 != 0)
        throw ParameterError("triangles holds " + std::to_string(triangles.size()) + " indices",
                             "pass three a triangle");
    const auto bad = std::find_if(triangles.begin(), triangles.end(),
                                  [points](std::uint32_t index) { return index >= points; });
    if (bad == triangles.end()) return;
    const auto at = bad - triangles.begin();
    throw ParameterError("triangles[" + std::to_string(at / 3) + "][" + std::to_string(at % 3) +
                             "] = " + std::to_string(*bad) + " for " + std::to_string(points) +
                             " points",
                         "pass indices from 0, less than the number of points");
}

// A point of no triangle, or of degenerate ones only, has no side: it looks up, so that nothing
// that is drawn ever holds a NaN.
float3 unit_or_up(const glm::dvec3& n) {
    const double length = glm::length(n);
    if (!(length > 0.0)) return {0.f, 0.f, 1.f};
    return {float(n.x / length), float(n.y / length), float(n.z / length)};
}

glm::dvec3 vec(const double3& p) {
    return glm::make_vec3(p.data());
}
glm::dvec3 vec(const float3& n) {
    return {n[0], n[1], n[2]};
}

}  // namespace

const char* to_string(AlphaMode mode) {
    return alpha_mode_names[std::size_t(mode)];
}

AlphaMode alpha_mode(std::string_view name) {
    const auto found = std::find(alpha_mode_names.begin(), alpha_mode_names.end(), name);
    if (found == alpha_mode_names.end())
        throw ParameterError("alpha_mode = \"" + std::string{name} + "\" is not known",
                             "choose \"opaque\", \"mask\" or \"blend\"");
    return AlphaMode(found - alpha_mode_names.begin());
}

Mesh::Mesh(Positions positions, std::vector<std::uint32_t> triangles, std::vector<float3> normals,
           std::vector<float> opacity, std::vector<float3> color)
    : Shape{std::move(positions), std::move(opacity), std::move(color)} {
    check_triangles(triangles, points_.size());
    triangles_ = std::move(triangles);
    own_normals_ = !normals.empty();
    normals_ = completed(std::move(normals));
}

bool Mesh::opaque() const {
    return min_opacity_ == 1.f && !has_alpha();
}

bool Mesh::has_alpha() const {
    return alpha_mode_ != AlphaMode::opaque && alpha_map_ && !uvs_->empty();
}

void Mesh::set_normals(std::vector<float3> normals) {
    const auto held = lock();
    const bool own = !normals.empty();
    normals_ = completed(std::move(normals));
    own_normals_ = own;
    revisions_.geometry = next_revision();
}

void Mesh::set_uvs(std::vector<float2> uvs) {
    if (!uvs.empty() && uvs.size() != points_.size())
        throw ParameterError("uvs has " + std::to_string(uvs.size()) + " entries for " +
                                 std::to_string(points_.size()) + " points",
                             "pass one a point, or none");
    check_values("uvs", flat(uvs), any_finite, 2);
    const auto held = lock();
    uvs_ = std::move(uvs);
    revisions_.geometry = revisions_.color = next_revision();
}

void Mesh::set_alpha(TextureMapPtr map, AlphaMode mode, float cutoff) {
    if (map) check_texture_map("alpha_map", *map, 1, 1.0);
    check_value("alpha_cutoff", cutoff, unit_interval);
    const auto held = lock();
    alpha_map_ = std::move(map);
    alpha_mode_ = mode;
    alpha_cutoff_ = cutoff;
    revisions_.geometry = next_revision();
}

void Mesh::set_color_map(TextureMapPtr map) {
    if (map) check_texture_map("color_map", *map, 3, brightness.max);
    const auto held = lock();
    color_map_ = std::move(map);
    revisions_.color = next_revision();
}

void Mesh::points_changed() {
    if (!own_normals_) normals_ = made_normals();
}

std::vector<float3> Mesh::made_normals() const {
    // In float64, so that neither thin triangles nor a mesh far from the origin lose their
    // direction.
    std::vector<glm::dvec3> sums(points_.size(), glm::dvec3{0.0});
    const std::vector<std::uint32_t>& corners = *triangles_;
    for (std::size_t t = 0; t < corners.size(); t += 3) {
        const glm::dvec3 a = vec(points_[corners[t]]);
        const glm::dvec3 ab = vec(points_[corners[t + 1]]) - a;
        const glm::dvec3 ac = vec(points_[corners[t + 2]]) - a;
        const glm::dvec3 twice_area = glm::cross(ab, ac);
        for (std::size_t corner = 0; corner < 3; ++corner) sums[corners[t + corner]] += twice_area;
    }
    std::vector<float3> normals(sums.size());
    std::transform(sums.begin(), sums.end(), normals.begin(), unit_or_up);
    return normals;
}

// What the caller gave, of length 1, with made ones in the place of zeros.
std::vector<float3> Mesh::completed(std::vector<float3> normals) const {
    if (normals.empty()) return made_normals();
    if (normals.size() != points_.size())
        throw ParameterError("normals has " + std::to_string(normals.size()) + " entries for " +
                                 std::to_string(points_.size()) + " points",
                             "pass one a point, or none to have them made");
    check_values("normals", flat(normals), any_finite, 3);
    const auto is_zero = [](const float3& n) { return n == float3{}; };
    std::vector<float3> made;
    if (std::any_of(normals.begin(), normals.end(), is_zero)) made = made_normals();
    for (std::size_t i = 0; i < normals.size(); ++i)
        normals[i] = is_zero(normals[i]) ? made[i] : unit_or_up(vec(normals[i]));
    return normals;
}

}  // namespace opacity
