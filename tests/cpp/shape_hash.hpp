// One number for all that a scene holds: another machine must find the same.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "opacity/scene/mesh.hpp"
#include "opacity/scene/particles.hpp"
#include "opacity/scene/strands.hpp"
#include "opacity/scene/volume.hpp"

// FNV-1a
class ShapeHash {
   public:
    std::uint64_t of(const std::vector<opacity::ShapePtr>& shapes) {
        for (const opacity::ShapePtr& shape : shapes) mix(*shape);
        return hash_;
    }

   private:
    void mix(const opacity::Shape& shape) {
        for (std::size_t i = 0; i < shape.points().size(); ++i) mix_bytes(shape.points()[i]);
        mix(shape.color());
        mix(shape.opacity());
        if (const auto* strands = dynamic_cast<const opacity::Strands*>(&shape)) {
            mix(strands->width());
            mix(strands->offsets());
        }
        if (const auto* mesh = dynamic_cast<const opacity::Mesh*>(&shape)) {
            mix(mesh->triangles());
            mix(mesh->uvs());
            for (const auto& map : {mesh->alpha_map(), mesh->color_map()})
                if (map) mix(map->values);
        }
        if (const auto* particles = dynamic_cast<const opacity::Particles*>(&shape))
            mix(particles->radius());
        if (const auto* volume = dynamic_cast<const opacity::Volume*>(&shape))
            mix(volume->extinction());
    }
    template <class Value>
    void mix(const std::vector<Value>& values) {
        for (const Value& value : values) mix_bytes(value);
    }
    template <class Value>
    void mix_bytes(const Value& value) {
        const auto* bytes = reinterpret_cast<const unsigned char*>(&value);
        for (std::size_t i = 0; i < sizeof value; ++i) hash_ = (hash_ ^ bytes[i]) * 1099511628211u;
    }

    std::uint64_t hash_ = 14695981039346656037u;
};
