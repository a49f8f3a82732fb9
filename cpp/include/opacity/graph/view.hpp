// From where a pass looks: a light or a camera. The matrix is float64; it is joined with a shape's
// transform and the origin of its points before anything becomes float32.
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "opacity/core/math.hpp"
#include "opacity/core/source.hpp"
#include "opacity/scene/shape.hpp"

namespace opacity {

using Uniforms = std::vector<std::pair<std::string, UniformValue>>;

// Uniforms that change together.
class UniformSet : public Source {
   public:
    using Source::Source;
    void update(Uniforms uniforms) {
        if (uniforms == uniforms_) return;
        uniforms_ = std::move(uniforms);
        touch();
    }
    void feed(Feeder& feeder) const override {
        for (const auto& [name, value] : uniforms_) feeder.uniform(name, value);
    }

   private:
    Uniforms uniforms_;
};

// Of a shape's chunks of primitives (Shape::chunks) those from `begin` to before `end`.
struct ChunkRange {
    std::size_t begin = 0, end = 0;
    bool operator==(const ChunkRange&) const = default;
};
using ChunkRanges = std::vector<ChunkRange>;
// The last range grows by a chunk that follows it.
void append_chunk(ChunkRanges& ranges, std::size_t chunk);

// Besides its uniforms, every draw gets mat4 u_<name>_from_local, by its name in GLSL.
class View : public UniformSet {
   public:
    using UniformSet::UniformSet;

    const double4x4& from_world() const noexcept { return from_world_; }
    // Through how many faces or splits it looks, each of which every shape is drawn for once, with
    // the number of the face as gl_InstanceID and five clip distances; 0: none, and once.
    int faces() const noexcept { return faces_; }
    void update(const double4x4& from_world, Uniforms uniforms, int faces = 0) {
        UniformSet::update(std::move(uniforms));
        if (from_world == from_world_ && faces == faces_) return;
        from_world_ = from_world;
        faces_ = faces;
        touch();
    }

    // Whether it looks from the origin of its coordinates, as cameras do; else these are of a map.
    bool has_eye() const noexcept { return has_eye_; }
    void look_from_origin() { has_eye_ = true; }

    // The part of the strands that it sees, each as many times as wide; 1: all, as they are.
    double strand_detail() const noexcept { return strand_detail_; }
    void set_strand_detail(double detail) {
        if (detail == strand_detail_) return;
        strand_detail_ = detail;
        touch();
    }

    // Whether it sees nothing of what lies within `reach` of a box of the world.
    using IsOut = std::function<bool(const Box& world, double reach)>;
    // Finds what of each shape it sees, as it and the shape are now; `is_out` must follow from what
    // it was updated with. What it is not asked about it sees all of.
    void cull(const std::vector<ShapePtr>& shapes, const IsOut& is_out);
    void see_all() { seen_.clear(); }
    // Neighbours merged, in rising order; null: all of them.
    const ChunkRanges* seen(const Shape& shape) const;
    // How many chunks of the shapes there are, and how many of them it does not see.
    struct ChunkCount {
        std::size_t all = 0, hidden = 0;
    };
    ChunkCount chunks(const std::vector<ShapePtr>& shapes) const;

   private:
    struct Seen {
        std::weak_ptr<const Shape> shape;
        Revision geometry = 0, transform = 0, view = 0;
        ChunkRanges ranges;
        ChunkCount count;
    };
    double4x4 from_world_ = identity;
    int faces_ = 0;
    bool has_eye_ = false;
    double strand_detail_ = 1.0;
    std::map<const Shape*, Seen> seen_;
};

}  // namespace opacity
