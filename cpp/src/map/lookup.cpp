#include "map/lookup.hpp"

#include <limits>

#include "map/surface.hpp"

namespace opacity {
namespace {

// What a curved surface may lie in front of its own plane, in texels.
constexpr float surface_bias_texels = 0.4f;

// A surface is looked up along its own plane, so that none of it shadows the rest.
float depth_at(const SeenReceiver& receiver, int x, int y, float depth) {
    if (receiver.lies_on != on_surface) return depth;
    const auto offset = [&](int texel, int axis) {
        return float(texel) + 0.5f - receiver.p_ls[axis];
    };
    return depth + plane_change({receiver.direction[0], receiver.direction[1]}, offset(x, 0),
                                offset(y, 1), receiver.largest_margin);
}

// Whether a filter there may meet a caster. Also false for a coordinate that is not finite: T = 1,
// never NaN.
bool is_met(const float3& place, int map_size_px) {
    const float reach = largest_filter_radius + 1.f, far = float(map_size_px) + reach;
    const auto is_near = [&](float v) { return v > -reach && v < far; };
    return place[2] > 0.f && is_near(place[0]) && is_near(place[1]);
}

}  // namespace

bool is_outside_map(const Receiver& receiver, const LightSpace& space) {
    return space.is_parallel() && !is_met(receiver.p_ls, space.map_size_px);
}

// Sums over the taps of a look-up. Weights are divided by their sum, so that T = 1 stays 1 exactly.
struct MapLookUp::Taps {
    float weight = 0.f;
    float lit = 0.f;            // weight of those that no opaque caster darkens
    float transmittance = 0.f;  // weight times T
    float optical_depth = 0.f;  // weight times optical depth
};

// A map of up to three texels has no border: its outer texels stand for what lies beside them.
// Elsewhere nothing casts outside.
void MapLookUp::add_tap(Taps& taps, const SeenReceiver& receiver, const OwnCaster& own, int x,
                        int y, float depth, float weight) const {
    const int size_px = space_.map_size_px;
    if (size_px < 4) x = std::clamp(x, 0, size_px - 1), y = std::clamp(y, 0, size_px - 1);
    taps.weight += weight;
    depth = depth_at(receiver, x, y, depth);
    if (!slab_.counts_at(depth)) return;
    float optical_depth = 0.f;
    if (x >= 0 && y >= 0 && x < size_px && y < size_px) {
        const std::size_t texel = std::size_t(receiver.corner_px[1] + y) * space_.width_px() +
                                  (receiver.corner_px[0] + x);
        const auto& opaque = is_bare(receiver) ? opaque_depth_.moved : opaque_depth_.first;
        if (opaque[texel] < std::min(depth, 1.f)) return;
        optical_depth = std::max(0.f, map_.optical_depth(texel, depth, own.at(x, y)));
    }
    taps.lit += weight;
    taps.transmittance += weight * std::exp(-optical_depth);
    taps.optical_depth += weight * optical_depth;
}

MapLookUp::Taps MapLookUp::filtered_taps(const SeenReceiver& receiver, float depth) const {
    Taps taps;
    const OwnCaster own{receiver, space_.depth_range};
    const float px = receiver.p_ls[0], py = receiver.p_ls[1];
    const auto at = [](float v) { return int(std::floor(v)); };
    if (filter_.kernel == FilterKernel::none) {
        add_tap(taps, receiver, own, at(px), at(py), depth, 1.f);
        return taps;
    }
    const float radius = radius_texels(receiver);
    if (filter_.kernel == FilterKernel::pcf) {  // at a radius of two texels they are neighbours
        for (int i = 0; i < 16; ++i) {
            const float x = px + (float(i % 4) - 1.5f) * (0.5f * radius);
            const float y = py + (float(i / 4) - 1.5f) * (0.5f * radius);
            add_tap(taps, receiver, own, at(x), at(y), depth, 1.f / 16.f);
        }
        return taps;
    }
    for (int y = at(py - radius); y < std::ceil(py + radius); ++y) {
        const float weight_y = filter_weight(filter_.kernel, float(y) - py, radius);
        for (int x = at(px - radius); x < std::ceil(px + radius); ++x) {
            const float weight_x = filter_weight(filter_.kernel, float(x) - px, radius);
            add_tap(taps, receiver, own, x, y, depth, weight_y * weight_x);
        }
    }
    return taps;
}

// By a split: with all that the filter reads.
bool MapLookUp::is_held(const SeenReceiver& receiver) const {
    const float radius = wanted_radius_texels(receiver), reach = radius + 1.f;
    const auto is_inside = [&](float v) {
        return v > reach && v < float(space_.map_size_px) - reach;
    };
    return radius <= largest_filter_radius && is_inside(receiver.p_ls[0]) &&
           is_inside(receiver.p_ls[1]);
}

SeenReceiver MapLookUp::seen_by_directional(const Receiver& receiver) const {
    for (int split = 1; split < space_.face_count(); ++split)
        if (const SeenReceiver there = seen(receiver, space_, split); is_held(there)) return there;
    return seen(receiver, space_);
}

float MapLookUp::transmittance(const Receiver& receiver, float width) const {
    if (space_.is_parallel()) return face_transmittance(seen_by_directional(receiver), width);
    // What is beside or behind a face lies in no shadow.
    float sum = 0.f;
    for (int eye = 0; eye < faces_.eye_count(); ++eye) {
        const MapFace& face = faces_[faces_.face_of(eye, receiver.p_ls)];
        const bool is_before = face.seen(receiver.p_ls)[2] > least_forward;
        sum += is_before ? face_transmittance(seen_through(face, receiver, space_), width)
                         : float(slab_.counts_at(0.f));
    }
    return sum / float(faces_.eye_count());
}

// World units toward the light within which nothing counts.
float MapLookUp::bias_of(const SeenReceiver& receiver, float width) const {
    float bias = float(bias_);
    if (bias_ < 0.0) {
        bias = std::max(width, float(space_.least_bias));
        if (receiver.lies_on == on_surface)
            bias = std::max(bias, surface_bias_texels / receiver.texels_per_unit);
    }
    return std::max(bias, receiver.own_reach);
}

float MapLookUp::look_up_depth(const SeenReceiver& receiver, float width) const {
    return receiver.p_ls[2] - bias_of(receiver, width) / float(space_.depth_range);
}

float MapLookUp::wanted_radius_texels(const SeenReceiver& receiver) const {
    return filter_.width < 0.f ? filter_.radius_texels
                               : 0.5f * filter_.width * receiver.texels_per_unit;
}

float MapLookUp::radius_texels(const SeenReceiver& receiver) const {
    return std::clamp(wanted_radius_texels(receiver), 1.f / 1024.f, largest_filter_radius);
}

DepthRange MapLookUp::depths(const Receiver& receiver, float width) const {
    DepthRange range{std::numeric_limits<float>::infinity(), 0.f};
    const auto extend = [&](float depth) {
        range = {std::min(range.first, depth), std::max(range.last, depth)};
    };
    const auto extend_by = [&](const SeenReceiver& seen) {
        const float depth = look_up_depth(seen, width);
        extend(depth);
        if (seen.lies_on != on_surface) return;
        const float reach = radius_texels(seen) + 1.f;  // of middles of texels
        for (const float x : {-reach, reach})
            for (const float y : {-reach, reach})
                extend(depth + plane_change({seen.direction[0], seen.direction[1]}, x, y,
                                            seen.largest_margin));
    };
    if (space_.map_size_px < 4) extend(0.f), extend(1.f);  // add_tap
    if (space_.is_parallel()) extend_by(seen_by_directional(receiver));
    for (int eye = 0; !space_.is_parallel() && eye < faces_.eye_count(); ++eye) {
        extend(0.f);  // where the eye does not see it
        extend_by(seen_through(faces_[faces_.face_of(eye, receiver.p_ls)], receiver, space_));
    }
    return range;
}

// Through one face of the map.
float MapLookUp::face_transmittance(const SeenReceiver& receiver, float width) const {
    const float depth = look_up_depth(receiver, width);
    if (!is_met({receiver.p_ls[0], receiver.p_ls[1], depth}, space_.map_size_px))
        return float(slab_.counts_at(depth));
    const Taps taps = filtered_taps(receiver, depth);
    if (!filter_.density) return taps.transmittance / taps.weight;
    // The density interpretation (Jansen and Bavoil 2010, section 6), of what no opaque caster
    // hides.
    if (!(taps.lit > 0.f)) return 0.f;
    return taps.lit / taps.weight * std::exp(-taps.optical_depth / taps.lit);
}

}  // namespace opacity
