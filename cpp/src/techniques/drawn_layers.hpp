// Opacity layers that passes have drawn: what stands in the map, and where its planes lie.
#pragma once

#include <initializer_list>
#include <string>
#include <vector>

#include "map/block_sample.hpp"
#include "opacity/core/split.hpp"
#include "opacity/graph/frame_graph.hpp"

namespace opacity::techniques {

constexpr int targets_per_pass = 8;   // what OpenGL 4.5 guarantees
constexpr int planes_per_target = 4;  // of what is blended; a scatter takes one

// Where a plane stands in a map: a channel of one of its images. GLSL: lib/layer_map.glsl.
struct Slot {
    std::size_t target, channel;
};
// Of plane k in 1 .. K; in a packed map the fourth place is the start of a texel's layers.
inline Slot slot_of(int k, bool is_packed, int an_image = planes_per_target) {
    const int slot = is_packed && k > 3 ? k : k - 1;
    return {std::size_t(slot / an_image), std::size_t(slot % an_image)};
}

// In the memory of an array of images, each of so many texels.
inline std::size_t index_of(const Slot& slot, std::size_t texel, std::size_t texel_count,
                            int an_image = planes_per_target) {
    return (slot.target * texel_count + texel) * std::size_t(an_image) + slot.channel;
}

// What one pass draws of layers: of so many layers of the map and of the moments, or one of these.
struct LayerPart {
    int first_target, target_count;
    bool planes, moments;
};

// Between which depths of light space a texel's layers lie; GLSL: lib/layer_span.glsl.
struct LayerSpan {
    Texture* start = nullptr;       // none: from depth 0
    Texture* end = nullptr;         // none: to `depth` behind the start
    Value<float>* depth = nullptr;  // none: 1
};

// Which of several split curves spaces the planes of a texel: in each square of the map the one of
// its split ratio, among evenly spaced ones; GLSL: techniques/bounding_opacity_maps.glsl.
struct LocalCurves {
    Texture* ratios = nullptr;  // none: one curve for all
    int region_px = 1;

    int count() const { return ratios ? split_trials : 1; }
};

// Planes of their own for tiles of texels: K - 1 of [0, 1], four to an image, between the 0 and the
// 1 that all have. GLSL: lib/tile_planes.glsl.
struct TilePlanes {
    Texture* places = nullptr;  // none: the same for all
    int tile_px = 1;
};

// How a look-up goes from one plane to the next: by a line, by a monotone cubic through four
// planes, or about the mean depth of what the layer holds, many casters or few. GLSL:
// lib/layers.glsl.
enum class Interpolation { linear, cubic, mean_depth, mean_depth_of_few };

// Planes of [0, 1], from the start of a texel's layers to their end, in an array texture of
// cumulative optical depth. Those of each curve, one after the other.
struct DrawnLayers {
    Texture& map;
    Value<std::vector<float>>& planes;
    LayerSpan span;
    Texture* moments = nullptr;     // sums of optical depth times position, in the same slots
    Value<float>* kappa = nullptr;  // the optical depth of a full channel, where one has 8 bits
    bool is_packed = false;
    bool ignores_beyond = false;  // what lies behind the last layer casts nothing
    bool is_swept = false;        // the map holds four planes at a time
    LocalCurves curves = {};
    TilePlanes tiles = {};  // if there are any, `planes` only says how many
    BlockSample kept = {};  // of the light's map; nothing stands between these blocks

    // Of a texel of the light's map, in an image.
    std::size_t place_of(int x, int y) const {
        return std::size_t(kept.packed(y)) * std::size_t(map.desc().width) +
               std::size_t(kept.packed(x));
    }
    int planes_an_image() const { return channels(map.desc().format); }
    // What tells a shader of it.
    Defines::value_type image_define() const {
        return {"PLANES_AN_IMAGE", std::to_string(planes_an_image())};
    }
    int layer_count() const { return int(planes.get().size()) / curves.count() - 1; }

    // The optical depth that a 1 in the map means.
    float unit() const { return kappa ? kappa->get() : 1.f; }
    Slot slot_of(int k) const {
        const Slot slot = techniques::slot_of(k, is_packed, planes_an_image());
        return is_swept ? Slot{0, slot.channel} : slot;
    }
    void add_to(Reads& reads) const {
        reads.push_back(&planes);
        for (const Source* source : std::initializer_list<const Source*>{
                 span.start, span.end, span.depth, kappa, curves.ratios, tiles.places})
            if (source) reads.push_back(source);
    }
};

// Where each plane of a texel stands in the memory of a map. Worked out once for all texels: to
// find a slot takes divisions, which every fragment would pay for.
class PlaneIndex {
   public:
    PlaneIndex(const DrawnLayers& drawn, std::size_t texel_count)
        : stride_{std::size_t(drawn.planes_an_image())},
          begins_(std::size_t(drawn.layer_count()) + 1) {
        for (int k = 1; k <= drawn.layer_count(); ++k)
            begins_[std::size_t(k)] =
                index_of(drawn.slot_of(k), 0, texel_count, drawn.planes_an_image());
    }

    // Of plane k in 1 .. K.
    std::size_t operator()(std::size_t texel, int k) const {
        return begins_[std::size_t(k)] + texel * stride_;
    }

   private:
    std::size_t stride_;
    std::vector<std::size_t> begins_;
};

}  // namespace opacity::techniques
