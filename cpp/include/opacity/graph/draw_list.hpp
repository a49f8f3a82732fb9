// Shapes that a pass draws, in three parts with a revision each, so that a pass which reads only
// where the shapes are does not run again when their colour changes.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "opacity/core/source.hpp"
#include "opacity/scene/shape.hpp"

namespace opacity {

// One part of every shape of a list: feeds per-vertex buffers b_<name>.
class ShapePart : public Source {
   public:
    using Source::Source;
    // Moves when the signature differs from the last one.
    void update(std::vector<Revision> signature);

   private:
    std::vector<Revision> signature_;
};

// Which shapes of a list a draw is about; none: all.
using ShapeFilter = std::function<bool(const Shape&)>;

class DrawList {
   public:
    explicit DrawList(const std::string& name)
        : geometry{name + ".geometry"},
          opacity{name + ".opacity"},
          color{name + ".color"},
          name_{name} {}

    ShapePart
        geometry;  // points, widths, connectivity, transforms, and which shapes are in the list
    ShapePart opacity;
    ShapePart color;

    const std::string& name() const noexcept { return name_; }
    const std::vector<ShapePtr>& shapes() const noexcept { return shapes_; }
    void update(std::vector<ShapePtr> shapes);

   private:
    std::string name_;
    std::vector<ShapePtr> shapes_;
};

}  // namespace opacity
