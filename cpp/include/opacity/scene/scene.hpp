// What is drawn, and what lights it. Shapes and lights are shared: change them at any time.
#pragma once

#include <memory>
#include <vector>

#include "opacity/scene/light.hpp"
#include "opacity/scene/shape.hpp"

namespace opacity {

class Scene {
   public:
    // Each at most once: a shape added twice would cast twice.
    void add(ShapePtr shape);
    void add(LightPtr light);
    void remove(const ShapePtr& shape);
    void remove(const LightPtr& light);

    const std::vector<ShapePtr>& shapes() const { return shapes_; }
    const std::vector<LightPtr>& lights() const { return lights_; }
    Box bounds() const;
    // Whether any shape stops colours differently.
    bool is_tinted() const;

   private:
    std::vector<ShapePtr> shapes_;
    std::vector<LightPtr> lights_;
};

}  // namespace opacity
