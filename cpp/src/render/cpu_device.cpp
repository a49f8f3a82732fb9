#include "render/cpu_device.hpp"

#include <algorithm>
#include <new>

#include "opacity/core/error.hpp"

namespace opacity::render {
namespace {

std::size_t bytes_of(const Resource& resource) {
    if (const auto* texture = dynamic_cast<const Texture*>(&resource))
        return size_bytes(texture->desc());
    return dynamic_cast<const Buffer&>(resource).size_bytes();
}

[[noreturn]] void no_shaders(const Pass& pass) {
    throw ParameterError("\"" + pass.name + "\" wants a shader",
                         "give the pass .on_cpu, or choose device=\"gpu\"");
}

}  // namespace

void CpuDevice::allocate(const Resource& resource) {
    std::vector<std::byte>& content = memory_[resource.name()];
    try {
        content.resize(bytes_of(resource));
    } catch (const std::bad_alloc&) {
        throw OutOfMemoryError("no memory is left for \"" + resource.name() + "\", " +
                                   std::to_string(bytes_of(resource)) + " bytes",
                               "lower map_size or layers");
    }
}

std::span<std::byte> CpuDevice::memory(const Resource& resource) {
    return memory_.at(resource.name());
}

// A target is one layer of its texture.
void CpuDevice::clear(const Pass& pass) {
    for (const Target& target : pass.writes) {
        const TextureDesc& desc = target.texture->desc();
        const std::span<std::byte> all = memory(*target.texture);
        const std::size_t count = std::size_t(desc.width) * desc.height * channels(desc.format);
        auto* first = reinterpret_cast<float*>(all.data()) + target.layer * count;
        if (desc.format == Format::depth32f) {
            std::fill_n(first, count, pass.state.clear_depth);
            continue;
        }
        const float4 color = target.clear_color.value_or(pass.state.clear_color);
        if (color == float4{}) {
            std::fill_n(first, count, 0.f);
            continue;
        }
        const std::size_t each = std::size_t(channels(desc.format));
        for (std::size_t i = 0; i < count; i += each) std::copy_n(color.begin(), each, first + i);
    }
}

void CpuDevice::draw(const Pass& pass, const Uniforms&, const ShapeFilter&) {
    no_shaders(pass);
}

void CpuDevice::dispatch(const Pass& pass, std::array<int, 3>, const Uniforms&) {
    no_shaders(pass);
}

void CpuDevice::dispatch_shapes(const Pass& pass, const ShapeFilter&) {
    no_shaders(pass);
}

void CpuDevice::fill(const Texture& texture, float value) {
    const std::span<std::byte> all = memory(texture);
    std::fill_n(reinterpret_cast<float*>(all.data()), all.size() / sizeof(float), value);
}

void CpuDevice::zero(const Resource& resource) {
    std::ranges::fill(memory(resource), std::byte{0});
}

void CpuDevice::write(const Resource& resource, std::span<const std::byte> content) {
    std::ranges::copy(content, memory(resource).begin());
}

void CpuDevice::read(const Resource& resource, std::span<std::byte> content) {
    const std::span<const std::byte> all = memory(resource);
    std::copy_n(all.begin(), std::min(all.size(), content.size()), content.begin());
}

}  // namespace opacity::render
