// Renders a scene, and answers how much light reaches a point; skips whatever has not changed.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "opacity/core/image.hpp"
#include "opacity/gl/context.hpp"
#include "opacity/graph/report.hpp"
#include "opacity/render_settings.hpp"
#include "opacity/scene/camera.hpp"
#include "opacity/scene/scene.hpp"
#include "opacity/technique.hpp"

namespace opacity {

// An intermediate texture, read back: rows in texel order, the light's first row first.
struct TextureContent {
    int width = 0, height = 0, layers = 0, channels = 0;  // layers 0: not an array
    std::vector<float> values;
};

// What the centre of each pixel sees, top row first: the point at which the picture looks T up,
// which on a strand is its centre line.
struct PictureReceivers {
    int width = 0, height = 0;
    std::vector<double> points_ws;  // three a pixel; 0 where nothing is seen
    std::vector<float> bias;  // the automatic bias, world units; negative where no shadow falls
};

class Renderer {
   public:
    // Without a context, a headless one is made.
    Renderer(std::shared_ptr<Scene> scene, const Camera& camera,
             std::shared_ptr<Technique> technique = {}, std::shared_ptr<gl::Context> context = {});
    // Without OpenGL: transmittance of techniques that have a form in C++, and no pictures. Without
    // a camera, whose view techniques may split, one that sees all of the scene is made.
    static Renderer on_cpu(std::shared_ptr<Scene> scene, std::shared_ptr<Technique> technique = {},
                           const Camera* camera = nullptr);
    ~Renderer();
    Renderer(Renderer&&) noexcept;

    RenderSettings& settings();
    Scene& scene();
    Technique& technique();
    const Camera& camera() const;
    bool is_on_cpu() const;
    gl::Context& context();  // ContextError on the CPU
    void set_technique(std::shared_ptr<Technique> technique);
    void set_camera(const Camera& camera);
    void set_size(int width_px, int height_px);
    // Linear RGBA behind everything; alpha 0 for a transparent picture.
    void set_background(const float4& rgba);
    const float4& background() const;

    // How many values T has at a point: 3, red, green and blue, where any shape of the scene is
    // tinted; else 1.
    std::size_t channels() const;

    // The picture: 4 * width * height floats, linear, premultiplied, top row first.
    Image render();
    void render(std::span<float> rgba);
    // T in [0, 1] at world points: the fraction of one light that arrives there. 1 without a light.
    // All channels of the first point, then of the second.
    std::vector<float> transmittance(const Positions& world_points, int light = 0);
    // At a shape's own points; the automatic bias is then that of its own strands.
    std::vector<float> transmittance(const Shape& shape, int light = 0);
    // The same into the caller's memory, of channels() floats a point.
    void transmittance(const Positions& world_points, int light, std::span<float> out);
    void transmittance(const Shape& shape, int light, std::span<float> out);

    // Width * height floats, top row first; "transmittance" has all channels. "coverage": how much
    // of a pixel the shapes cover, the picture's alpha without its background. Of the first strand
    // or surface in the middle of each pixel: "transmittance", T of a light (1 where there is
    // none); "depth", the distance from the eye in world units (infinite); "object_id", its index
    // in the scene (-1).
    std::vector<float> image(std::string_view name, int light = 0);

    // Of the picture that render() makes with antialiasing 1.
    PictureReceivers receivers();

    // World to the light's map as the last frame fitted it: x, y in texels, z in 0 .. 1 along it.
    double4x4 light_from_world(int light = 0) const;
    // Side of a texel of the light's map at world points, in world units.
    std::vector<double> texel_sides(const Positions& world_points, int light = 0) const;

    const Report& report() const;
    std::vector<ResourceMemory> memory() const;  // of the last frame, or look-up of T
    // The passes of the last frame and what they read and write, as a Graphviz digraph.
    std::string graph_dot() const;
    TextureContent read(const std::string& texture) const;
    // Forgets every cached pass.
    void invalidate();
    // Called before each pass that runs, on the rendering thread; may throw: what ran is kept.
    void set_interrupt_check(std::function<void()> check);
    // Searches the split again at the next frame.
    void needs_recompute();

   private:
    struct Impl;
    explicit Renderer(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> impl_;
};

}  // namespace opacity
