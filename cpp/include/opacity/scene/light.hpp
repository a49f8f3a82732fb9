// Lights: at infinity, at a point, a cone from a point, an area. What arrives is colour times
// intensity, by the attenuation of its distance; shadows are the business of techniques.
#pragma once

#include <memory>
#include <vector>

#include "opacity/core/math.hpp"

namespace opacity {

class Technique;

class Light {
   public:
    virtual ~Light() = default;
    Light& operator=(const Light&) = delete;
    virtual const char* kind() const = 0;

    // Linear RGB, and its factor, in [0, 1e9].
    const float3& color() const { return color_; }
    float intensity() const { return intensity_; }
    void set_color(float3 color);
    void set_intensity(float intensity);

    // Its own shadow method, and texels along each side of its maps; null and 0: the renderer's.
    const std::shared_ptr<Technique>& technique() const { return technique_; }
    int map_size() const { return map_size_; }
    void set_technique(std::shared_ptr<Technique> technique) { technique_ = std::move(technique); }
    void set_map_size(int map_size_px);  // in 0..16384

   protected:
    Light(float3 color, float intensity);
    Light(const Light&) = default;

   private:
    float3 color_;
    float intensity_;
    std::shared_ptr<Technique> technique_;
    int map_size_ = 0;
};

using LightPtr = std::shared_ptr<Light>;

class DirectionalLight : public Light {
   public:
    // The direction in which light travels, of any length but 0.
    explicit DirectionalLight(double3 direction = {0.5, 0.3, -0.8}, float3 color = {1.f, 1.f, 1.f},
                              float intensity = 1.f);
    const char* kind() const override { return "directional"; }

    const double3& direction() const { return direction_; }  // of length 1
    void set_direction(double3 direction);

   private:
    double3 direction_;
};

// At a distance d, colour times intensity is divided by constant + linear d + quadratic d^2.
struct Attenuation {
    double constant = 1.0, linear = 0.0, quadratic = 0.0;
    bool operator==(const Attenuation&) const = default;
};

class PositionalLight : public Light {
   public:
    const double3& position() const { return position_; }  // world
    const Attenuation& attenuation() const { return attenuation_; }
    void set_position(double3 position);
    void set_attenuation(const Attenuation& attenuation);  // none below 0, not all 0

   protected:
    PositionalLight(double3 position, float3 color, float intensity);

   private:
    double3 position_;
    Attenuation attenuation_;
};

// Shines in all directions.
class PointLight : public PositionalLight {
   public:
    explicit PointLight(double3 position, float3 color = {1.f, 1.f, 1.f}, float intensity = 1.f)
        : PositionalLight{position, color, intensity} {}
    const char* kind() const override { return "point"; }
};

// Shines into a cone.
class SpotLight : public PositionalLight {
   public:
    // The cone's full angle is in 1..170 degrees; over the outer part `softness`, in 0..1, of its
    // half the light fades.
    SpotLight(double3 position, double3 direction, double angle_deg = 45.0,
              float3 color = {1.f, 1.f, 1.f}, float intensity = 1.f);
    const char* kind() const override { return "spot"; }

    const double3& direction() const { return direction_; }  // of length 1
    double angle_deg() const { return angle_deg_; }
    double softness() const { return softness_; }
    void set_direction(double3 direction);
    void set_angle_deg(double angle_deg);
    void set_softness(double softness);

   private:
    double3 direction_;
    double angle_deg_ = 45.0, softness_ = 0.1;
};

// A parallelogram that shines to all sides as the mean of n x n points on it: soft shadows.
class AreaLight : public PositionalLight {
   public:
    // `position` is its middle; the edges are whole sides.
    AreaLight(double3 position, double3 edge_u, double3 edge_v, int samples = 4,
              float3 color = {1.f, 1.f, 1.f}, float intensity = 1.f);
    const char* kind() const override { return "area"; }

    const double3& edge_u() const { return edge_u_; }
    const double3& edge_v() const { return edge_v_; }
    int samples() const { return samples_; }
    void set_edges(double3 edge_u, double3 edge_v);
    void set_samples(int samples);  // n in 1..8, along each edge

   private:
    double3 edge_u_, edge_v_;
    int samples_ = 4;
};

// From where it shines: none for a directional light; the middles of n x n equal parts of an area.
std::vector<double3> light_points(const Light& light);

}  // namespace opacity
