// The window: an orbit around the casters, a light to move, keys for technique and layers.
#pragma once

#include <memory>
#include <string>

#include "opacity/gl/window.hpp"
#include "opacity/opacity.hpp"
#include "options.hpp"

namespace opacity::demo {

// What is looked at, and how light and camera stand to it.
struct Stage {
    std::shared_ptr<Scene> scene;
    std::shared_ptr<DirectionalLight> light;
    Box casters;
    double3 view_direction, up;

    Camera camera(double distance_factor = 1.0) const;
};

Stage load_stage(const Options& options);
// Technique and settings as the options ask.
Renderer make_renderer(const Options& options, const Stage& stage,
                       std::shared_ptr<gl::Context> context);

class Viewer {
   public:
    Viewer(const Options& options, Stage stage);
    // Until the window is closed, or for options.frames frames.
    void run();

   private:
    void drag(const gl::Drag& drag);
    void key(const gl::Key& key);
    void next_technique();
    void change_layers(int change);
    void show_title(double frame_ms);
    void save(const std::string& path) const;

    Options options_;
    Stage stage_;
    double distance_factor_ = 1.0;
    std::shared_ptr<gl::Window> window_;
    Renderer renderer_;
    Image image_;
};

}  // namespace opacity::demo
