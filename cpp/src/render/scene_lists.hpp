// Which shapes each kind of pass draws.
#pragma once

#include "opacity/graph/draw_list.hpp"
#include "opacity/scene/scene.hpp"

namespace opacity::render {

struct SceneLists {
    DrawList translucent{"translucent casters"};
    DrawList opaque{"opaque casters"};
    DrawList visible{"shapes"};

    void update(const Scene& scene);
};

}  // namespace opacity::render
