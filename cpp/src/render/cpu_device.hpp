// Executes passes without OpenGL: resources lie in memory, and every pass with a shader runs its
// form in C++.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "opacity/graph/device.hpp"

namespace opacity::render {

class CpuDevice : public Device {
   public:
    bool runs_shaders() const override { return false; }
    Revision shader_revision() override { return 0; }
    void allocate(const Resource& resource) override;
    void release(const Resource& resource) noexcept override { memory_.erase(resource.name()); }
    std::span<std::byte> memory(const Resource& resource) override;

    void clear(const Pass& pass) override;
    void draw(const Pass& pass, const Uniforms& extra, const ShapeFilter& wanted) override;
    void dispatch(const Pass& pass, std::array<int, 3> groups, const Uniforms& extra) override;
    void dispatch_shapes(const Pass& pass, const ShapeFilter& wanted) override;
    void zero(const Resource& resource) override;
    void fill(const Texture& texture, float value) override;
    void write(const Resource& resource, std::span<const std::byte> content) override;
    void read(const Resource& resource, std::span<std::byte> content) override;
    void finish() override {}

   private:
    std::map<std::string, std::vector<std::byte>> memory_;  // by the resource's name
};

}  // namespace opacity::render
