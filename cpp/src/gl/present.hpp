// Draws a linear picture to the screen's framebuffer, encoded as sRGB.
#pragma once

#include <memory>

#include "gl/program.hpp"
#include "gl/texture.hpp"

namespace opacity::gl {

class Presenter {
   public:
    explicit Presenter(std::shared_ptr<Context> context);
    // Over the whole viewport of framebuffer 0.
    void draw(const float* rgba, int width, int height, int viewport_width, int viewport_height);

   private:
    std::shared_ptr<Context> context_;
    Program program_;
    VertexArray vertex_array_;
    Texture picture_;
};

}  // namespace opacity::gl
