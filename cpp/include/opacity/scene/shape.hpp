// What strands, meshes, particles and volumes share: opacity, colour, a transform, the flags, and
// one revision for each part that can change alone.
#pragma once

#include <cstddef>
#include <memory>
#include <mutex>
#include <vector>

#include "opacity/core/math.hpp"
#include "opacity/core/shared.hpp"
#include "opacity/core/source.hpp"
#include "opacity/scene/positions.hpp"
#include "opacity/scene/tint.hpp"

namespace opacity {

struct ChunkSlot;
struct PrimitiveChunks;

// Every setter checks first: one that throws a ParameterError leaves the shape as it was.
class Shape {
   public:
    Shape& operator=(const Shape&) = delete;
    virtual ~Shape() = default;
    // Another shape of the same content, which both share until either gets other: for many copies
    // of one tree, each with a transform and flags of its own. Equal revisions tell a device that
    // it holds that content already.
    std::shared_ptr<Shape> instance() const;

    // In the shape's own coordinates, everything that it can cover: widths included.
    Box local_bounds() const { return point_bounds_.padded(margin()); }
    // How far it reaches beyond its points, in its own units.
    virtual double margin() const { return 0.0; }
    virtual const char* kind() const = 0;
    Box bounds() const { return local_bounds().transformed(transform_); }

    const Positions& points() const { return points_; }
    void set_points(Positions points);  // the number of points stays

    // One value for all, or one a point. Opacity in [0, 1], colour linear RGB in [0, 1e9].
    const std::vector<float>& opacity() const { return *opacity_; }
    const std::vector<float3>& color() const { return *color_; }
    void set_opacity(std::vector<float> opacity);
    // Red, green and blue light stopped by parts of their own; opacity() is then their mean.
    void set_opacity_rgb(const std::vector<float3>& rgb);
    void set_color(std::vector<float3> color);

    // Of its opacity, or of a volume's extinction; null: all colours are stopped alike.
    const TintPtr& tint() const { return tint_; }
    // The shape as light of one colour meets it: an instance without a tint. Equal revisions of
    // this one make equal revisions of that.
    std::shared_ptr<Shape> in_channel(std::size_t channel) const;

    // Shape to world, affine and invertible, in float64.
    const double4x4& transform() const { return transform_; }
    void set_transform(const double4x4& transform);
    // The factor by which the transform scales lengths: |det|^(1/3).
    double scale() const;

    bool casts() const { return casts_; }
    bool receives() const { return receives_; }
    void set_casts(bool casts);
    void set_receives(bool receives);

    // Opaque shapes go to the opaque depth map, translucent ones to the opacity maps; a shape whose
    // opacity is 0 everywhere casts nothing.
    virtual bool opaque() const = 0;
    virtual bool invisible_to_light() const;
    float min_opacity() const { return min_opacity_; }  // of all points
    // Whether it keeps light from anything.
    bool is_caster() const { return casts_ && !invisible_to_light() && points_.size() > 0; }
    // Mean width of its strands in world units, which the automatic bias goes by; 0 for a surface.
    virtual double strand_width() const { return 0.0; }

    // One revision for each part: geometry is points, widths and connectivity, and what decides
    // where a shape is at all, such as the alpha of a leaf.
    struct Revisions {
        Revision geometry = next_revision(), transform = next_revision(), opacity = next_revision(),
                 color = next_revision(), flags = next_revision();
        bool operator==(const Revisions&) const = default;
    };
    const Revisions& revisions() const { return revisions_; }
    // Its primitives in chunks of neighbours, as its points are now; made when first asked for.
    // With the lock held.
    std::shared_ptr<const PrimitiveChunks> chunks() const;
    // Held by setters, and by a renderer while it copies: one thread may change what another draws.
    std::unique_lock<std::mutex> lock() const { return std::unique_lock{mutex_}; }

   protected:
    Shape(Positions points, std::vector<float> opacity, std::vector<float3> color);
    Shape(const Shape& other);  // for clone(), with the other's lock held
    virtual std::shared_ptr<Shape> clone() const = 0;
    // Takes what a colour of the tint has.
    virtual void show(const Tint::Channel& channel);
    void check_attribute_size(const char* name, std::size_t size) const;
    // Called with the lock held, after set_points: what is made from the points is made again.
    virtual void points_changed() {}
    // ParameterError where the points are not the caller's to set.
    virtual void check_points_are_settable() const {}

    Positions points_;
    Box point_bounds_;
    Revisions revisions_;
    TintPtr tint_;
    // Of all points, so that nobody has to look at each of them to sort shapes.
    float min_opacity_ = 0.f, max_opacity_ = 0.f;

   private:
    void assign_opacity(std::vector<float> opacity);
    void find_extremes();

    Shared<std::vector<float>> opacity_;
    Shared<std::vector<float3>> color_;
    double4x4 transform_ = identity;
    bool casts_ = true, receives_ = true;
    mutable std::shared_ptr<ChunkSlot> chunks_;
    mutable std::mutex mutex_;
};

using ShapePtr = std::shared_ptr<Shape>;

}  // namespace opacity
