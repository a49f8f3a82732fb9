// Optical depth along light, of many texels at common planes: what layers hold, drawn or rebinned.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace opacity {

// Planes of [0, 1], from the first caster of a texel to its last. Texel t has values[t * layers() +
// k - 1] in front of planes[k].
struct OpticalDepthProfiles {
    std::span<const float> planes;
    std::span<const float> values;
    // How far in front of a receiver casters begin to count, for each texel; none: 0.
    std::span<const float> biases = {};
    // Of optical depth times position, as `values` are of optical depth; none: layers do not tell
    // where in them it lies.
    std::span<const float> moments = {};

    std::size_t layers() const { return planes.size() - 1; }
    std::size_t texel_count() const { return values.size() / layers(); }
    double bias(std::size_t t) const { return biases.empty() ? 0.0 : double(biases[t]); }
    // In front of planes 1, 2, ..
    std::span<const float> texel(std::size_t t) const {
        return values.subspan(t * layers(), layers());
    }
    std::span<const float> texel_moments(std::size_t t) const {
        return moments.empty() ? moments : moments.subspan(t * layers(), layers());
    }
};

// Optical depth in front of plane k; nothing is in front of plane 0.
inline double at_plane(std::span<const float> texel, std::size_t k) {
    return k == 0 ? 0.0 : double(texel[k - 1]);
}
inline bool is_covered(std::span<const float> texel) {
    return texel.back() > 0.f;
}

// Where between two planes x lies.
struct PlaneCell {
    std::size_t index;
    double along;  // of [0, 1]
};
PlaneCell cell_of(std::span<const float> planes, double x);

// Fine profiles are histograms of single casters: the first lies on plane 0 and the last on plane 1
// by definition of the bounds, the others somewhere in their cells.
class FineProfiles {
   public:
    explicit FineProfiles(const OpticalDepthProfiles& profiles);

    const OpticalDepthProfiles& profiles() const noexcept { return profiles_; }
    // One of the equal fragments that a cell of this texel holds, if it has this optical depth. By
    // their mean, yet no more than chance puts in one cell of a texel with so many empty ones: a
    // leaf may be more opaque than most, and is one all the same.
    double fragment_of(std::span<const float> texel, double cell) const;
    // In front of x in (0, 1) of a texel.
    double in_front(std::span<const float> texel, double x) const;
    // The same texels at other planes: their values, and moments.
    std::vector<float> rebinned(std::span<const float> planes) const;
    std::vector<float> rebinned_moments(std::span<const float> planes) const;

   private:
    std::size_t index_of(std::span<const float> texel) const {
        return std::size_t(texel.data() - profiles_.values.data()) / texel.size();
    }
    // What a cell holds beside the first and the last caster, which lie on planes.
    double inside(std::span<const float> texel, std::size_t cell) const {
        return inside_[index_of(texel) * texel.size() + cell];
    }

    OpticalDepthProfiles profiles_;
    // Mean of the cells that stand between empty ones. 0 where casters fill their cells, as smoke
    // does.
    double fragment_;
    std::vector<std::size_t> most_;  // of each texel
    std::vector<double> inside_;     // of each cell
};

}  // namespace opacity
