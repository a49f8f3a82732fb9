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

std::array<int, 3> work_groups(int count) {
    constexpr int group_size = 64;      // lib/invocation.glsl
    constexpr int most_groups = 32768;  // OpenGL promises 65,535 in each direction
    const int groups = (count + group_size - 1) / group_size;
    const int columns = std::min(groups, most_groups);
    return {columns, (groups + columns - 1) / columns, 1};
}

void PassContext::draw(const Uniforms& extra, const ShapeFilter& wanted) {
    graph_.device_.draw(pass_, extra, wanted);
}

void PassContext::dispatch_shapes(const ShapeFilter& wanted) {
    graph_.device_.dispatch_shapes(pass_, wanted);
}

void PassContext::dispatch(int count, const Uniforms& extra) {
    if (count > 0) graph_.device_.dispatch(pass_, work_groups(count), extra);
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
    try {
        graph_.device_.allocate(buffer);
    } catch (...) {
        buffer.resize(0);  // so that the next frame tries again
        throw;
    }
}

void PassContext::write(const Resource& resource, std::span<const std::byte> content) {
    require_store(resource);
    graph_.device_.write(resource, content);
}

void PassContext::fill(const Texture& texture, float value) {
    require_store(texture);
    graph_.device_.fill(texture, value);
}

void PassContext::zero(const Texture& texture) {
    require_store(texture);
    graph_.device_.zero(texture);
}

void PassContext::note_hidden_chunks() {
    if (!pass_.draws || !pass_.view || pass_.draws_unseen) return;
    const View::ChunkCount chunks = pass_.view->chunks(pass_.draws->shapes());
    if (chunks.hidden == 0) return;
    note_ += (note_.empty() ? "" : ", ") + std::to_string(chunks.hidden) + " of " +
             std::to_string(chunks.all) + " chunks out of view";
}

void PassContext::read_bytes(const Resource& resource, std::span<std::byte> content) {
    const auto& reads = pass_.reads;
    const auto& stores = pass_.stores;
    if (std::find(reads.begin(), reads.end(), &resource) == reads.end() &&
        std::find(stores.begin(), stores.end(), &resource) == stores.end())
        undeclared(pass_, resource, "reads back", "reads");
    graph_.device_.read(resource, content);
}

std::span<std::byte> PassContext::memory_bytes(const Resource& resource) {
    const auto holds = [&](const auto& sources) {
        return std::find(sources.begin(), sources.end(), &resource) != sources.end();
    };
    const bool is_target =
        std::any_of(pass_.writes.begin(), pass_.writes.end(),
                    [&](const Target& target) { return target.texture == &resource; });
    if (!is_target && !holds(pass_.reads) && !holds(pass_.stores))
        undeclared(pass_, resource, "uses", "reads");
    return graph_.device_.memory(resource);
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
