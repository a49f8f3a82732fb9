// What a caster's fragments are taken from, and where they go.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "map/block_sample.hpp"
#include "map/face.hpp"
#include "map/interval.hpp"
#include "map/light_casters.hpp"
#include "map/split_place.hpp"

namespace opacity {

struct Fragment {
    int x, y;                // in the whole map
    std::size_t texel;       // y * width_px + x
    float depth, depth_end;  // of strands and surfaces the same
    float optical_depth;     // 0 unless asked for
};

// A band of rows of a face: one thread's work, so that no two write to one texel, and each texel
// gets its fragments in the same order on any number of threads.
struct Rows {
    int begin, end;
};
// Those of a face between two places in it; none where these are not numbers.
inline Rows rows_between(float low, float high, int map_size_px) {
    const float last = float(map_size_px) - 1.f;
    if (!(high >= 0.f && low <= last + 1.f)) return {0, 0};
    return {int(std::clamp(low, 0.f, last)), int(std::clamp(high, 0.f, last)) + 1};
}

struct FragmentSource {
    LightCasters& casters;
    const std::vector<ShapePtr>& shapes;
    const LightSpace& space;
    std::span<const float> opaque_depth;  // one value a texel; empty: there is no opaque caster
    bool paper_deposit = false;
    bool optical_depth = true;
    bool moved_back = false;  // surfaces, away from the light (map/surface.hpp)
    SplitPlace split = {};    // of a directional light, whose texels `space` tells then
    BlockSample sample = {};  // of the whole map's texels, those that are wanted

    // Of these shapes alone.
    FragmentSource of(const std::vector<ShapePtr>& some) const {
        return {casters,       some,       space, opaque_depth, paper_deposit,
                optical_depth, moved_back, split, sample};
    }
    // The same through one of the faces, or splits, of the light.
    FragmentSource through(const LightSpace& space_there, int face) const {
        return {casters,       shapes,        space_there, opaque_depth,
                paper_deposit, optical_depth, moved_back,  split_place(space_there, face),
                sample};
    }
};

// Leaves out what no receiver can notice: casters behind all receivers or behind an opaque one,
// where T is 0 without them. Of an interval that such a depth cuts, what is in front of it remains.
template <class Add>
class FragmentSink {
   public:
    FragmentSink(const FragmentSource& source, const std::array<int, 2>& corner_px, Add& add)
        : source_{source},
          sample_{source.sample},
          corner_px_{corner_px},
          width_px_{source.space.width_px()},
          add_{add} {}

    bool wants_column(int x) const { return sample_.holds(x + corner_px_[0]); }
    bool wants_row(int y) const { return sample_.holds(y + corner_px_[1]); }
    // `x` and `y` within the face.
    template <class OpticalDepth>
    [[gnu::always_inline]] void operator()(int x, int y, float depth, float depth_end,
                                           OpticalDepth optical_depth) {
        x += corner_px_[0], y += corner_px_[1];
        if (!sample_.holds(x, y)) return;
        const std::size_t texel = std::size_t(y) * width_px_ + x;
        depth = std::max(depth, 0.f);
        depth_end = std::max(depth_end, depth);
        float last = 1.f;
        if (!source_.opaque_depth.empty()) last = std::min(last, source_.opaque_depth[texel]);
        if (!(depth <= last)) return;
        Fragment fragment{x, y, texel, depth, depth_end, 0.f};
        if (source_.optical_depth) fragment.optical_depth = optical_depth();
        if (depth_end > last) {
            fragment.optical_depth *= part_in_front(depth, depth_end, last);
            fragment.depth_end = last;
        }
        add_(fragment);
    }

   private:
    const FragmentSource& source_;
    const BlockSample sample_;
    const std::array<int, 2> corner_px_;
    const int width_px_;
    Add& add_;
};

}  // namespace opacity
