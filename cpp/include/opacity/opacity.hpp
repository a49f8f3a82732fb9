// The engine, in reading order: a scene holds shapes and lights; a frame graph runs passes; a
// technique is a list of passes; a renderer ties them to a context.
#pragma once

#include "opacity/core/error.hpp"
#include "opacity/core/image.hpp"
#include "opacity/core/math.hpp"
#include "opacity/core/param.hpp"
#include "opacity/core/source.hpp"
// scene
#include "opacity/scene/camera.hpp"
#include "opacity/scene/light.hpp"
#include "opacity/scene/mesh.hpp"
#include "opacity/scene/particles.hpp"
#include "opacity/scene/scene.hpp"
#include "opacity/scene/strands.hpp"
#include "opacity/scene/volume.hpp"
// files and generated scenes
#include "opacity/io/load.hpp"
// truth by rays
#include "opacity/trace.hpp"
// passes
#include "opacity/graph/frame_graph.hpp"
#include "opacity/graph/report.hpp"
// shadows
#include "opacity/plugin.hpp"
#include "opacity/technique.hpp"
#include "opacity/technique_description.hpp"
// pictures
#include "opacity/gl/context.hpp"
#include "opacity/renderer.hpp"

namespace opacity {

// "major.minor.patch"
const char* version();

}  // namespace opacity
