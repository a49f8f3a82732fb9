// Which shapes each kind of pass draws.
#pragma once

#include <string_view>

#include "opacity/core/param.hpp"
#include "opacity/graph/draw_list.hpp"
#include "opacity/scene/scene.hpp"
#include "scene/view_frustum.hpp"

namespace opacity::render {

// How the camera sees what is translucent: the words of RenderSettings::compositing, but auto.
enum class Compositing { opaque, subsets, sorted, exact, maps };

// What the setting means for a scene; auto: sorted where one shape alone is translucent, and no
// mesh, whose triangles may be large and cross; else maps, which need no order.
Compositing compositing_of(const Choice& setting, const Scene& scene);

struct SceneLists {
    // What a light sees.
    DrawList translucent{"translucent casters"};
    DrawList opaque{"opaque casters"};
    // What the camera sees: all that has a surface; and all shapes, each in one of three.
    DrawList surfaces{"surfaces"};
    DrawList solid{"solids"};          // drawn as if opaque
    DrawList parted{"parted shapes"};  // drawn as if opaque, in subsets
    DrawList blended{"translucent shapes"};

    void update_casters(const Scene& scene);
    // What is out of view is in no list. The blended ones in an order have the farthest first.
    void update_seen(const Scene& scene, Compositing compositing, const CameraView& view);
    std::size_t out_of_view = 0;  // shapes
};

}  // namespace opacity::render
