// What every map shares in the look-up: the front test, the opaque depth map, and the filter. GLSL:
// lib/lookup.glsl.
#pragma once

#include <span>

#include "map/filter.hpp"
#include "map/own_deposit.hpp"

namespace opacity {

// What the translucent casters of one texel have in front of a depth, without the receiver's own
// part of it. Each technique brings its own, as it does texel_optical_depth in GLSL.
class TexelMap {
   public:
    virtual ~TexelMap() = default;
    virtual float optical_depth(std::size_t texel, float depth, const OwnDeposit& own) const = 0;
};

struct Filter {  // as lib/filter.glsl is told it
    FilterKernel kernel = FilterKernel::box;
    float radius_texels = 0.5f;
    float width = -1.f;    // world units from edge to edge; negative: as the radius says
    bool density = false;  // average optical depth, not T
};

// The first opaque caster of each texel: where it is, and, for bare points, moved away from the
// light (map/surface.hpp).
struct OpaqueDepth {
    std::span<const float> first, moved;
};

// A sweep asks slab by slab, and adds up what it is answered: a tap counts where it lies. Also one
// that is not a number does, once.
struct DepthSlab {
    float begin = 0.f, end = 1.f;
    bool is_first = true, is_last = true;  // what lies before, or behind, counts too

    bool counts_at(float depth) const {
        return (is_first || depth >= begin) && (is_last || !(depth >= end));
    }
};

struct DepthRange {
    float first, last;
};

// Of a directional light: so far beside its map, or in front of all casters, that T is 1 there
// without a look-up, whatever the filter. Of others that shows only face by face.
bool is_outside_map(const Receiver& receiver, const LightSpace& space);

class MapLookUp {
   public:
    // `bias` in world units; negative: automatic.
    MapLookUp(const LightSpace& space, const TexelMap& map, const OpaqueDepth& opaque_depth,
              const Filter& filter, double bias, const DepthSlab& slab = {})
        : space_{space},
          faces_{space},
          map_{map},
          opaque_depth_{opaque_depth},
          filter_{filter},
          bias_{bias},
          slab_{slab} {}

    // T in [0, 1], of a positional light the mean over its points; `width` as in Query.
    float transmittance(const Receiver& receiver, float width) const;
    // Of its taps, or more.
    DepthRange depths(const Receiver& receiver, float width) const;

   private:
    struct Taps;
    float radius_texels(const SeenReceiver& receiver) const;
    float look_up_depth(const SeenReceiver& receiver, float width) const;
    float bias_of(const SeenReceiver& receiver, float width) const;
    float wanted_radius_texels(const SeenReceiver& receiver) const;
    bool is_held(const SeenReceiver& receiver) const;
    SeenReceiver seen_by_directional(const Receiver& receiver) const;
    float face_transmittance(const SeenReceiver& receiver, float width) const;
    void add_tap(Taps& taps, const SeenReceiver& receiver, const OwnCaster& own, int x, int y,
                 float depth, float weight) const;
    Taps filtered_taps(const SeenReceiver& receiver, float depth) const;

    const LightSpace& space_;
    MapFaces faces_;
    const TexelMap& map_;
    OpaqueDepth opaque_depth_;
    Filter filter_;
    double bias_;
    DepthSlab slab_;
};

}  // namespace opacity
