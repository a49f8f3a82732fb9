#include <algorithm>

#include "opacity/core/error.hpp"
#include "opacity/graph/frame_graph.hpp"

namespace opacity {
namespace {

[[noreturn]] void undeclared(const Pass& pass, const Source& source, const char* what,
                             const char* field) {
    throw ParameterError("pass \"" + pass.name + "\" " + what + " \"" + source.name() +
                             "\", which it did not declare",
                         "add &" + source.name() + " to ." + field + " of the pass");
}

}  // namespace

void PassContext::draw() {
    graph_.device_.draw(pass_);
}

void PassContext::dispatch(int x, int y, int z, const Uniforms& extra) {
    if (x > 0 && y > 0 && z > 0) graph_.device_.dispatch(pass_, {x, y, z}, extra);
}

void PassContext::resize(Texture& texture, const TextureDesc& desc) {
    require_store(texture);
    texture.describe(desc);
    graph_.allocate(texture);
}

void PassContext::resize(Buffer& buffer, std::size_t size_bytes) {
    require_store(buffer);
    if (buffer.size_bytes() == size_bytes) return;
    buffer.resize(size_bytes);
    graph_.device_.allocate(buffer);
}

void PassContext::write(const Resource& resource, std::span<const std::byte> content) {
    require_store(resource);
    graph_.device_.write(resource, content);
}

void PassContext::zero(const Texture& texture) {
    require_store(texture);
    const std::vector<std::byte> zeros(size_bytes(texture.desc()));
    graph_.device_.write(texture, zeros);
}

void PassContext::read_bytes(const Resource& resource, std::span<std::byte> content) {
    const auto& reads = pass_.reads;
    const auto& stores = pass_.stores;
    if (std::find(reads.begin(), reads.end(), &resource) == reads.end() &&
        std::find(stores.begin(), stores.end(), &resource) == stores.end())
        undeclared(pass_, resource, "reads back", "reads");
    graph_.device_.read(resource, content);
}

void PassContext::require_value(const Source& value) const {
    if (std::find(pass_.values.begin(), pass_.values.end(), &value) == pass_.values.end())
        undeclared(pass_, value, "sets", "values");
}

void PassContext::require_store(const Resource& resource) const {
    if (std::find(pass_.stores.begin(), pass_.stores.end(), &resource) == pass_.stores.end())
        undeclared(pass_, resource, "stores into", "stores");
}

}  // namespace opacity
