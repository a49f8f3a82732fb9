// The fragments of volumes: one a texel and slab, for the ray through the texel's middle. GLSL:
// casters/volume.vert.glsl and casters/volume.frag.glsl.
#pragma once

#include <functional>

#include "map/fragment_source.hpp"

namespace opacity {

struct SlabTexel {
    int x, y;
    VoxelChord chord;
};
// Those of all slabs across that axis of the volume which runs most along the light.
void volume_texels(const LightCaster& caster, const FragmentSource& source, const MapFace* face,
                   Rows rows, const std::function<void(const SlabTexel&)>& texel);

template <class Sink>
void volume_fragments(const LightCaster& caster, const FragmentSource& source, const MapFace* face,
                      Rows rows, Sink&& sink) {
    volume_texels(caster, source, face, rows, [&](const SlabTexel& t) {
        sink(t.x, t.y, t.chord.begin, t.chord.end, [&] { return t.chord.optical_depth; });
    });
}

}  // namespace opacity
