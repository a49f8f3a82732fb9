// A perspective camera that looks at a point.
#pragma once

#include "opacity/core/math.hpp"

namespace opacity {

class Scene;

class Camera {
   public:
    // World positions; `up` is any vector not parallel to the view; the vertical field of view in
    // degrees, 1 .. 170.
    static Camera look_at(double3 eye, double3 target, double3 up = {0, 0, 1},
                          double fov_deg = 35.0);
    // Sees all of the scene's bounds, looking along `direction`; a unit box where the scene is
    // empty.
    static Camera fit(const Scene& scene, double3 direction = {0.3, 1.0, -0.25},
                      double3 up = {0, 0, 1}, double fov_deg = 35.0);
    // Sees all of one box, in any picture at least as wide as high: for scenes with a wide ground
    // that need not be in view.
    static Camera fit(const Box& bounds, double3 direction, double3 up, double fov_deg);

    const double3& eye() const { return eye_; }
    const double3& target() const { return target_; }
    const double3& up() const { return up_; }
    double fov_deg() const { return fov_deg_; }
    // World to view: x right, y up, looking along -z.
    double4x4 view_from_world() const;

    bool operator==(const Camera&) const = default;

   private:
    Camera(double3 eye, double3 target, double3 up, double fov_deg);
    double distance_to_see(const Box& box) const;

    double3 eye_, target_, up_;
    double fov_deg_;
};

}  // namespace opacity
