// The fragments that casters leave in the light's map, by the deposit rule (docs/accuracy.md); each
// kind of caster in a file of its own. GLSL: casters.vert.glsl and lib/deposit.glsl.
#pragma once

#include "core/parallel.hpp"
#include "map/particle_fragments.hpp"
#include "map/segment_fragments.hpp"
#include "map/triangle_fragments.hpp"
#include "map/volume_fragments.hpp"

namespace opacity {

// Strands come and go through a band, so that their points lie apart: those are sent for early.
inline constexpr std::size_t segments_ahead = 8;

// Those of some primitives of one caster, within the rows of a face.
template <class Sink>
void caster_fragments(const LightCaster& caster, std::span<const std::uint32_t> primitives,
                      const FragmentSource& source, const MapFace* face, Rows rows, Sink&& sink) {
    switch (caster.kind) {
        case CasterKind::strands:
            for (std::size_t k = 0; k < primitives.size(); ++k) {
                const std::size_t soon = std::min(k + segments_ahead, primitives.size() - 1);
                __builtin_prefetch(&caster.points[caster.indices[primitives[soon]]]);
                segment_fragments(caster, caster.indices[primitives[k]], source, face, rows, sink);
            }
            return;
        case CasterKind::mesh:
            for (const std::uint32_t i : primitives)
                triangle_fragments(caster, std::size_t{3} * i, source, face, rows, sink);
            return;
        case CasterKind::particles:
            for (const std::uint32_t i : primitives)
                particle_fragments(caster, i, source, face, rows, sink);
            return;
        case CasterKind::volume:
            volume_fragments(caster, source, face, rows, sink);
    }
}

template <class Add>
void for_each_fragment(const FragmentSource& source, Add add) {
    std::vector<const LightCaster*> casters;
    for (const ShapePtr& shape : source.shapes)
        casters.push_back(&source.casters.caster(shape, source.space));
    const std::size_t bands = bands_a_face(source.space);
    const MapFaces faces{source.space};
    parallel_for(bands * std::size_t(source.space.face_count()), [&](std::size_t band) {
        const int face = int(band / bands), first = int(band % bands) * band_rows;
        const Rows rows{first, std::min(first + band_rows, source.space.map_size_px)};
        const LightSpace space = with_texels_of(source.space, face);
        const FragmentSource through = source.through(space, face);
        FragmentSink<Add> sink{through, space.corner_px(face), add};
        const MapFace* seen_through = space.is_parallel() ? nullptr : &faces[face];
        for (const LightCaster* caster : casters)
            caster_fragments(*caster, caster->bands.primitives(band), through, seen_through, rows,
                             sink);
    });
}

}  // namespace opacity
