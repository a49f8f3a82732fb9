#include "opacity/scene/camera.hpp"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <glm/gtc/type_ptr.hpp>

#include "opacity/core/error.hpp"
#include "opacity/scene/scene.hpp"
#include "scene/check.hpp"

namespace opacity {
namespace {

constexpr Allowed field_of_view{1.0, 170.0, "in 1..170 degrees"};

glm::dvec3 vec(const double3& v) {
    return glm::make_vec3(v.data());
}
double3 array(const glm::dvec3& v) {
    return {v.x, v.y, v.z};
}

// Zero stays zero. Scaled first: the squares of a tiny vector would be 0.
glm::dvec3 unit(const glm::dvec3& v) {
    const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
    return largest == 0.0 ? v : glm::normalize(v / largest);
}

}  // namespace

Camera::Camera(double3 eye, double3 target, double3 up, double fov_deg)
    : eye_{eye}, target_{target}, up_{up}, fov_deg_{fov_deg} {}

Camera Camera::look_at(double3 eye, double3 target, double3 up, double fov_deg) {
    check_vector("camera eye", eye);
    check_vector("camera target", target);
    check_vector("camera up", up);
    check_value("camera fov_deg", fov_deg, field_of_view);
    if (eye == target)
        throw ParameterError("the camera's eye and target are one point",
                             "move the eye away from what it looks at");
    const glm::dvec3 side = glm::cross(unit(vec(target) - vec(eye)), unit(vec(up)));
    if (glm::length(side) < 1e-9)
        throw ParameterError(
            "the camera's up is zero or parallel to its view",
            "pass an up direction across the view; (0, 1, 0) where it looks along z");
    return Camera{eye, target, up, fov_deg};
}

Camera Camera::fit(const Scene& scene, double3 direction, double3 up, double fov_deg) {
    return fit(scene.bounds(), direction, up, fov_deg);
}

Camera Camera::fit(const Box& bounds, double3 direction, double3 up, double fov_deg) {
    check_vector("camera direction", direction);
    if (direction == double3{})
        throw ParameterError("camera direction = (0, 0, 0)",
                             "pass the direction in which it looks");
    check_value("camera fov_deg", fov_deg, field_of_view);
    // An empty scene is a picture too.
    const Box box = bounds.empty() ? Box{{-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}} : bounds;
    const glm::dvec3 center = vec(box.center());
    // A single point has no size: far enough away that eye and target differ in float64.
    const double least = std::max(1e-9 * glm::length(center), 1e-12);
    const glm::dvec3 ahead = unit(vec(direction));
    const double unit_distance = box.radius() > least ? box.radius() : std::max(1.0, least);
    const Camera probe = look_at(array(center - ahead * unit_distance), array(center), up, fov_deg);
    constexpr double margin = 1.05;
    const double distance = margin * std::max(probe.distance_to_see(box), 1e-3 * unit_distance);
    return look_at(array(center - ahead * distance), array(center), up, fov_deg);
}

// From the target, for every corner of the box to lie in the smaller field of view of a square
// picture.
double Camera::distance_to_see(const Box& box) const {
    const double4x4 view = view_from_world();
    const double3 target = transform_point(view, target_);
    const double tangent = std::tan(0.5 * glm::radians(fov_deg_));
    double distance = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
        const double3 p = transform_point(
            view, {corner & 1 ? box.max[0] : box.min[0], corner & 2 ? box.max[1] : box.min[1],
                   corner & 4 ? box.max[2] : box.min[2]});
        const double nearer = p[2] - target[2];  // than the target
        const double off_axis = std::max(std::abs(p[0]), std::abs(p[1]));
        distance = std::max(distance, nearer + off_axis / tangent);
    }
    return distance;
}

double4x4 Camera::view_from_world() const {
    const glm::dvec3 eye = vec(eye_);
    const glm::dvec3 back = -unit(vec(target_) - eye);
    const glm::dvec3 right = unit(glm::cross(unit(vec(up_)), back));
    const glm::dvec3 up = glm::cross(back, right);
    return {right.x, right.y, right.z, -glm::dot(right, eye), up.x, up.y, up.z, -glm::dot(up, eye),
            back.x,  back.y,  back.z,  -glm::dot(back, eye),  0.0,  0.0,  0.0,  1.0};
}

}  // namespace opacity
