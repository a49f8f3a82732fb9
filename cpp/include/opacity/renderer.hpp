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
#include "opacity/core/param.hpp"
#include "opacity/gl/context.hpp"
#include "opacity/graph/report.hpp"
#include "opacity/scene/camera.hpp"
#include "opacity/scene/scene.hpp"
#include "opacity/technique.hpp"

namespace opacity {

struct RenderSettings : ParamOwner {
    RenderSettings() : ParamOwner{"renderer", "pyopacity render --help"} {}
    Param<int> width{*this, "width", 1024, {1, 16384}, "Pixels of the picture, across."};
    Param<int> height{*this, "height", 768, {1, 16384}, "Pixels of the picture, down."};
    AutoParam<int> map_size{*this,
                            "map_size",
                            512,
                            {1, 16384},
                            "Texels along each side of the light's maps; auto: from the width and "
                            "spacing of the strands, or from filter_width."};
    Param<bool> steady{
        *this, "steady", true,
        "A light holds on to its map while what casts lies within, so that shadows do "
        "not swim; off: each frame fits anew, whatever was before."};
    Param<int> antialiasing{*this, "antialiasing", 2, {1, 8}, "n x n samples a pixel, averaged."};
    Choice compositing{*this,
                       "compositing",
                       {"auto", "opaque", "subsets", "sorted", "exact", "maps"},
                       "How what is translucent covers what lies behind it: opaque, as in the "
                       "papers; subsets: the mean of three, each of a third of the strands; sorted "
                       "by shape and primitive; exact: sorted lists; maps: without an order, by "
                       "maps of the camera's own; auto: maps where anything is translucent."};
    Param<double> ambient{*this,
                          "ambient",
                          0.12,
                          {0.0, 100.0},
                          "Light from everywhere, unshadowed, as a factor of colour."};
    Param<double> specular{*this, "specular", 0.25, {0.0, 100.0}, "Strength of the highlight."};
    Param<double> shininess{*this, "shininess", 40.0, {1.0, 10000.0}, "Exponent of the highlight."};
    Param<double> wrap{*this,
                       "wrap",
                       0.0,
                       {0.0, 1.0},
                       "How far light reaches around the edge of a surface's lit side."};
    AutoParam<double> backlight{*this,
                                "backlight",
                                {0.0, 1.0},
                                "Part of the light on a translucent surface that comes out on its "
                                "other side; auto: it has no sides, only the maps darken it."};
    Param<double> phase{*this,
                        "phase",
                        0.0,
                        {-0.99, 0.99},
                        "Mean cosine of scattering in particles and volumes; 0: to all sides, "
                        "above: onward."};
    Param<double> shadow_intensity{
        *this, "shadow_intensity", 1.0, {0.0, 1.0}, "Part of the shadow that the picture shows."};
};

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

    // The picture: 4 * width * height floats, linear, premultiplied, top row first.
    Image render();
    void render(std::span<float> rgba);
    // T in [0, 1] at world points: the fraction of one light that arrives there. 1 without a light.
    std::vector<float> transmittance(const Positions& world_points, int light = 0);
    // At a shape's own points; the automatic bias is then that of its own strands.
    std::vector<float> transmittance(const Shape& shape, int light = 0);

    // Width * height floats, top row first. "coverage": how much of a pixel the shapes cover, the
    // picture's alpha without its background. Of the first strand or surface in the middle of each
    // pixel: "transmittance", T of a light (1 where there is none); "depth", the distance from the
    // eye in world units (infinite); "object_id", its index in the scene (-1).
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
