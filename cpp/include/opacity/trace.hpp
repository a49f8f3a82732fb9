// How much light reaches a point, by rays through the real geometry: what every map is measured
// against (docs/accuracy.md, "Truth by rays"). Float64 on the CPU; needs no OpenGL.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "opacity/scene/scene.hpp"

namespace opacity {

struct TraceSettings {
    int light = 0;  // index into the scene's lights
    // Side, in world units, of a square about each point and across its ray; T is its mean over
    // `samples` rays (1 .. 65536), one in each of as many parts of equal area. 0: one ray. One for
    // all points, or one a point.
    std::vector<double> footprint{0.0};
    int samples = 64;
    // World units: casters nearer than this toward the light do not count. None: automatic. One for
    // all points, or one a point.
    std::vector<double> bias;
    // Of a shape's points, those that are asked about, in this order; otherwise all.
    std::optional<std::vector<std::size_t>> indices;
    // "embree" or "builtin", which give the same bits; "auto" takes the first of trace_backends().
    std::string backend = "auto";
    // 0: as many as the machine runs at once. The result does not depend on it.
    int threads = 0;
    // Called with the fraction done, in 0 .. 1, on the calling thread only, some twenty times a
    // second; may throw to stop. The last call is with 1.
    std::function<void(double)> progress;
};

// T in [0, 1] at world points: the product of 1 - opacity over what lies between each point and
// the light; 0 behind what is opaque, 1 without a light. Of an area light the mean over its points.
// Of a scene with a tinted shape (Scene::is_tinted) three values a point: red, green, blue.
std::vector<float> trace_transmittance(const Scene& scene, const Positions& world_points,
                                       const TraceSettings& settings = {});
// At a shape's own points, of a volume the centres of its voxels. The automatic bias is then that
// of its own strands; a particle does not count at its own centre, nor half a voxel at its own.
std::vector<float> trace_transmittance(const Scene& scene, const Shape& shape,
                                       const TraceSettings& settings = {});

// What can find the casters near a ray in this build, the faster first; "builtin" is always there.
std::vector<std::string> trace_backends();

}  // namespace opacity
