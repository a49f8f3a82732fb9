// The fragments that casters leave in the light's map, by the deposit rule (docs/accuracy.md).
// GLSL: casters.vert.glsl and lib/deposit.glsl.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <span>

#include "core/opacity.hpp"
#include "core/parallel.hpp"
#include "map/light_casters.hpp"
#include "map/ribbon.hpp"

namespace opacity {

struct Fragment {
    int x, y;
    std::size_t texel;  // y * map_size_px + x
    float depth;
    float optical_depth;  // 0 unless asked for
};

// A band of rows of the map: one thread's work, so that no two write to one texel, and each texel
// gets its fragments in the same order on any number of threads.
struct Rows {
    int begin, end;
};

struct FragmentSource {
    LightCasters& casters;
    const std::vector<ShapePtr>& shapes;
    const LightSpace& space;
    std::span<const float> opaque_depth;  // one value a texel; empty: there is no opaque caster
    bool paper_deposit = false;
    bool optical_depth = true;
    bool surface_margin = true;  // moves surfaces away from the light
};

// Leaves out what no receiver can notice: casters behind all receivers or behind an opaque one,
// where T is 0 without them.
template <class Add>
class FragmentSink {
   public:
    FragmentSink(const FragmentSource& source, Add& add) : source_{source}, add_{add} {}

    template <class OpticalDepth>
    void operator()(int x, int y, float depth, OpticalDepth optical_depth) {
        const std::size_t texel = std::size_t(y) * source_.space.map_size_px + x;
        depth = std::max(depth, 0.f);
        if (!(depth <= 1.f)) return;
        if (!source_.opaque_depth.empty() && depth > source_.opaque_depth[texel]) return;
        add_(Fragment{x, y, texel, depth, source_.optical_depth ? optical_depth() : 0.f});
    }

   private:
    const FragmentSource& source_;
    Add& add_;
};

// std::floor and std::ceil are calls where the target has no instruction for them. |v| < 2^31.
inline int floor_of(float v) {
    const int truncated = int(v);
    return truncated - (float(truncated) > v);
}
inline int ceil_of(float v) {
    return -floor_of(-v);
}

// One segment's fragments within the rows. `Sink` takes x, y, depth and what gives the optical
// depth.
template <class Sink>
void segment_fragments(const LightCaster& caster, std::size_t first, const FragmentSource& source,
                       Rows rows, Sink&& sink) {
    const float4 &root = caster.points[first], &tip = caster.points[first + 1];
    const MajorSegment s{{root[0], root[1], root[2]}, {tip[0], tip[1], tip[2]}};
    if (s.dx == 0.f) return;  // along the light: no area, no texel
    const Rows all{0, source.space.map_size_px};
    const Rows columns = s.steep ? rows : all, across = s.steep ? all : rows;
    const auto within = [](float v, Rows range) {
        return std::clamp(v, float(range.begin), float(range.end));
    };
    const int begin = floor_of(within(s.begin(), columns));
    const int end = ceil_of(within(s.end(), columns));
    const float root_opacity = caster.opacity_at(first), tip_opacity = caster.opacity_at(first + 1);
    const auto emit = [&](int column, int row, float depth, float place, float f, float c) {
        const auto optical_depth = [&] {
            return f * optical_depth_of(MajorSegment::mix(root_opacity, tip_opacity, place) * c);
        };
        s.steep ? sink(row, column, depth, optical_depth) : sink(column, row, depth, optical_depth);
    };
    for (int column = begin; column < end; ++column) {
        const float middle = float(column) + 0.5f;
        const RibbonColumn ribbon{s, root[3], tip[3], middle};
        const float reach = source.paper_deposit ? 1.f : ribbon.half_width;
        const int low = floor_of(within(ribbon.y - reach, across));
        const int high = ceil_of(within(ribbon.y + reach, across));
        for (int row = low; row < high; ++row) {
            if (source.paper_deposit) {
                if (const auto line = line_coverage(s, middle, float(row) + 0.5f))
                    emit(column, row, line->depth, line->place, 1.f, 1.f);
                continue;
            }
            const float c = ribbon.across(float(row) + 0.5f);
            if (ribbon.along > 0.f && c > 0.f)
                emit(column, row, ribbon.depth, ribbon.place, std::min(ribbon.along, 1.f), c);
        }
    }
}

// The texels within the rows whose middle one triangle covers, with their weights of its corners;
// and its slope, by which it is moved away from the light.
struct TriangleTexel {
    int x, y;
    float weights[3];
    float margin;
};
void triangle_texels(const std::array<float4, 3>& corners, const LightSpace& space, Rows rows,
                     const std::function<void(const TriangleTexel&)>& texel);

template <class Sink>
void triangle_fragments(const LightCaster& caster, std::size_t first, const FragmentSource& source,
                        Rows rows, Sink&& sink) {
    const std::uint32_t* corner = &caster.indices[first];
    const std::array<float4, 3> points{caster.points[corner[0]], caster.points[corner[1]],
                                       caster.points[corner[2]]};
    triangle_texels(points, source.space, rows, [&](const TriangleTexel& t) {
        float depth = 0.f, opacity = 0.f;
        for (int i = 0; i < 3; ++i) {
            depth += t.weights[i] * points[i][2];
            opacity += t.weights[i] * caster.opacity_at(corner[i]);
        }
        sink(t.x, t.y, source.surface_margin ? depth + t.margin : depth,
             [&] { return optical_depth_of(opacity); });
    });
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
        for (const LightCaster* caster : casters) {
            if (caster->strands)
                for (const std::uint32_t first : caster->indices)
                    segment_fragments(*caster, first, source, rows, sink);
            else
                for (std::size_t first = 0; first + 2 < caster->indices.size(); first += 3)
                    triangle_fragments(*caster, first, source, rows, sink);
        }
    });
}

}  // namespace opacity
