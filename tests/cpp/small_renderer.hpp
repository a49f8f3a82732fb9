// A small scene, and a renderer that draws it in little time.
#pragma once

#include <cstring>
#include <memory>
#include <string>
#include <vector>

#include "opacity/renderer.hpp"
#include "opacity/scene/mesh.hpp"
#include "opacity/scene/strands.hpp"

namespace small {

using namespace opacity;

inline std::shared_ptr<Mesh> square(double height, double half_size, float opacity, float3 color) {
    const double s = half_size, z = height;
    return std::make_shared<Mesh>(
        Positions{std::vector<double>{-s, -s, z, s, -s, z, s, s, z, -s, s, z}},
        std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3}, std::vector<float3>{},
        std::vector<float>{opacity}, std::vector<float3>{color});
}

inline std::shared_ptr<Scene> scene_of(std::vector<ShapePtr> shapes,
                                       const DirectionalLight& light) {
    auto scene = std::make_shared<Scene>();
    for (ShapePtr& shape : shapes) scene->add(std::move(shape));
    scene->add(std::make_shared<DirectionalLight>(light));
    return scene;
}

// Strands and an opaque square above an opaque ground.
inline std::shared_ptr<Scene> hairy_scene() {
    std::vector<double> xyz;
    std::vector<std::int64_t> offsets{0};
    for (int strand = 0; strand < 9; ++strand) {
        for (int i = 0; i < 4; ++i)
            xyz.insert(xyz.end(),
                       {0.25 * strand - 1.0, 0.3 * i - 0.5, 0.3 + 0.1 * i + 0.05 * (strand % 3)});
        offsets.push_back(offsets.back() + 4);
    }
    auto hair = std::make_shared<Strands>(Positions{xyz}, offsets, std::vector<float>{0.15f});
    return scene_of({hair, square(0.2, 0.3, 1.f, {0, 1, 0}), square(0, 1.5, 1.f, {1, 1, 1})},
                    DirectionalLight{});
}

inline Camera above() {
    return Camera::look_at({0.4, -2.0, 3.0}, {0, 0, 0});
}

inline void make_small(Renderer& renderer) {
    renderer.set_size(40, 30);
    renderer.settings().map_size.assign(std::int64_t{32});
    renderer.settings().antialiasing.assign(std::int64_t{1});
    renderer.settings().compositing.assign(std::string{"opaque"});
}

inline Renderer small_renderer(const std::shared_ptr<Scene>& scene,
                               std::shared_ptr<gl::Context> context = {},
                               std::shared_ptr<Technique> technique = {}) {
    Renderer renderer{scene, above(), std::move(technique), std::move(context)};
    make_small(renderer);
    return renderer;
}

// What a technique makes of casters with this transmittance: to a shadow map they are opaque.
inline double seen_by(const std::string& technique, double transmittance) {
    if (technique == "unshadowed") return 1.0;
    return technique == "shadow_map" && transmittance < 1.0 ? 0.0 : transmittance;
}

// How far from it a technique may be where its planes do not matter.
inline double bound_of(const std::string& technique) {
    if (technique == "fourier_opacity_maps") return 0.1;   // seven coefficients of steps ring
    return technique == "deep_shadow_maps" ? 0.01 : 1e-5;  // its error_bound
}

inline bool same(const Image& a, const Image& b) {
    return a.width == b.width && a.height == b.height && a.rgba.size() == b.rgba.size() &&
           std::memcmp(a.rgba.data(), b.rgba.data(), a.rgba.size() * sizeof(float)) == 0;
}

}  // namespace small
