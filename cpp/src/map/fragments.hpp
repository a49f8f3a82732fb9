// The fragments that casters leave in the light's map, by the deposit rule (docs/accuracy.md); each
// kind of caster in a file of its own. GLSL: casters.vert.glsl and lib/deposit.glsl.
#pragma once

#include "core/parallel.hpp"
#include "map/particle_fragments.hpp"
#include "map/segment_fragments.hpp"
#include "map/triangle_fragments.hpp"
#include "map/volume_fragments.hpp"

namespace opacity {

// All of one caster within the rows.
template <class Sink>
void caster_fragments(const LightCaster& caster, const FragmentSource& source, Rows rows,
                      Sink&& sink) {
    switch (caster.kind) {
        case CasterKind::strands:
            for (const std::uint32_t first : caster.indices)
                segment_fragments(caster, first, source, rows, sink);
            return;
        case CasterKind::mesh:
            for (std::size_t first = 0; first + 2 < caster.indices.size(); first += 3)
                triangle_fragments(caster, first, source, rows, sink);
            return;
        case CasterKind::particles:
            for (std::size_t i = 0; i < caster.points.size(); ++i)
                particle_fragments(caster, i, source, rows, sink);
            return;
        case CasterKind::volume:
            volume_fragments(caster, source, rows, sink);
    }
}

template <class Add>
void for_each_fragment(const FragmentSource& source, Add add) {
    std::vector<const LightCaster*> casters;
    for (const ShapePtr& shape : source.shapes)
        casters.push_back(&source.casters.caster(shape, source.space));
    constexpr int band_rows = 32;
    const int size_px = source.space.map_size_px;
    parallel_for((size_px + band_rows - 1) / band_rows, [&](std::size_t band) {
        const Rows rows{int(band) * band_rows, std::min(int(band + 1) * band_rows, size_px)};
        FragmentSink<Add> sink{source, add};
        for (const LightCaster* caster : casters) caster_fragments(*caster, source, rows, sink);
    });
}

}  // namespace opacity
