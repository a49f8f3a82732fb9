// The part of the plane across a light that its map shows. It stays while what must be seen stays
// within, so that casters and lights which move a little do not make every texel swim.
#pragma once

#include <array>
#include <optional>

#include "opacity/core/math.hpp"

namespace opacity {

struct Window {
    std::array<double, 2> middle{};
    double side = 0.0;

    static Window around(const Box& box);  // its x and y
    bool contains(const Window& other) const;
    bool operator==(const Window&) const = default;
};

// The held window, if it contains what is needed and is not more than a third wider; else a new
// one, which is held from now on: the first just as wide as needed, later ones with room to move.
Window steady(std::optional<Window>& held, const Window& needed);

}  // namespace opacity
