// What casts and what receives, as far as one light is concerned.
#pragma once

#include <functional>
#include <map>

#include "opacity/scene/scene.hpp"

namespace opacity {

// A box in whatever coordinates `place` gives for a world point, of all points of a shape: exact,
// and found again only when the shape, or what `key` stands for, moved.
class CasterBoxes {
   public:
    using Place = std::function<double3(const double3&)>;
    using Key = std::array<double, 8>;

    // With the shape's lock held.
    const Box& box(const Shape& shape, const Key& key, const Place& place);
    void forget_absent(const Scene& scene);

   private:
    struct Cached {
        Revision geometry = 0, transform = 0;
        Key key{};
        Box box;
    };
    std::map<const Shape*, Cached> cache_;
};

}  // namespace opacity
