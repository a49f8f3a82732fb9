#include "map/caster_bands.hpp"

#include <utility>

#include "core/parallel.hpp"
#include "map/particle_fragments.hpp"
#include "map/segment_fragments.hpp"
#include "map/triangle_fragments.hpp"

namespace opacity {
namespace {

constexpr std::size_t primitives_at_once = 1 << 14;

class BandFinder {
   public:
    BandFinder(const LightCaster& caster, const LightSpace& space, std::span<const char> held)
        : caster_{caster}, space_{space}, held_{held}, faces_{space} {}

    // Calls found(band) for each band of each face that a primitive may touch.
    template <class Found>
    void find(std::size_t primitive, Found found) const {
        if (!held_.empty() && !held_[primitive]) return;
        for (int face = 0; face < space_.face_count(); ++face) {
            const Rows rows = rows_of(primitive, face);
            const std::size_t first = std::size_t(face) * bands_a_face(space_);
            for (int row = rows.begin / band_rows * band_rows; row < rows.end; row += band_rows)
                found(first + std::size_t(row / band_rows));
        }
    }

   private:
    Rows rows_of(std::size_t i, int face) const {
        const MapFace* through = space_.is_parallel() ? nullptr : &faces_[face];
        const SplitPlace split = split_place(space_, space_.is_parallel() ? face : 0);
        switch (caster_.kind) {
            case CasterKind::strands:
                return segment_rows(caster_, caster_.indices[i], through, split,
                                    space_.map_size_px);
            case CasterKind::mesh:
                return triangle_rows(caster_, &caster_.indices[3 * i], through, split,
                                     space_.map_size_px);
            default:
                return particle_rows(caster_, i, space_, through, split);
        }
    }

    const LightCaster& caster_;
    const LightSpace& space_;
    std::span<const char> held_;
    MapFaces faces_;
};

}  // namespace

std::size_t primitive_count(const LightCaster& caster) {
    switch (caster.kind) {
        case CasterKind::strands:
            return caster.indices.size();
        case CasterKind::mesh:
            return caster.indices.size() / 3;
        case CasterKind::particles:
            return caster.points.size();
        default:
            return 0;
    }
}

// By counting, part by part, so that primitives keep their order on any number of threads.
CasterBands::CasterBands(const LightCaster& caster, const LightSpace& space,
                         std::span<const char> held) {
    const BandFinder finder{caster, space, held};
    const std::size_t bands = bands_a_face(space) * std::size_t(space.face_count());
    const std::size_t count = primitive_count(caster);
    const std::size_t parts = (count + primitives_at_once - 1) / primitives_at_once;
    std::vector<std::size_t> next(parts * bands, 0);  // of each part, in each band
    const auto next_of = [&](std::size_t primitive) {
        return &next[primitive / primitives_at_once * bands];
    };
    parallel_parts(count, primitives_at_once, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            finder.find(i, [&](std::size_t band) { ++next_of(begin)[band]; });
    });
    std::size_t sum = 0;
    for (std::size_t band = 0; band < bands; ++band) {
        firsts_.push_back(sum);
        for (std::size_t part = 0; part < parts; ++part)
            sum += std::exchange(next[part * bands + band], sum);
    }
    firsts_.push_back(sum);
    primitives_.resize(sum);
    parallel_parts(count, primitives_at_once, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            finder.find(i, [&](std::size_t band) {
                primitives_[next_of(begin)[band]++] = std::uint32_t(i);
            });
    });
}

}  // namespace opacity
