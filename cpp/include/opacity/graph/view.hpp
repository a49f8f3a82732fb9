// From where a pass looks: a light or a camera. The matrix is float64; it is joined with a shape's
// transform and the origin of its points before anything becomes float32.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "opacity/core/math.hpp"
#include "opacity/core/source.hpp"

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

   private:
    double4x4 from_world_ = identity;
    int faces_ = 0;
};

}  // namespace opacity
