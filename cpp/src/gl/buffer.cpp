#include "gl/buffer.hpp"

#include <algorithm>
#include <cassert>
#include <string>

#include "gl/check.hpp"

namespace opacity::gl {

Buffer::Buffer(std::shared_ptr<Context> context, std::size_t size_bytes, const void* data)
    : size_bytes_{size_bytes} {
    const Context::Use use{*context};
    object_ = BufferObject{context};
    // OpenGL has no empty storage, and a block that a
    // shader declares must have some buffer behind it.
    const std::size_t storage_bytes = std::max<std::size_t>(size_bytes, 16);
    const GladGLContext& gl = context->gl();
    const bool fits = data && size_bytes == storage_bytes;
    const std::string doing = "allocating a buffer of " + size_text(size_bytes);
    check_fits(*context, size_bytes, doing);
    gl.NamedBufferStorage(name(), GLsizeiptr(storage_bytes), fits ? data : nullptr,
                          GL_DYNAMIC_STORAGE_BIT);
    check_errors(*context, doing);
    if (data && !fits) write({static_cast<const std::byte*>(data), size_bytes});
}

void Buffer::write(std::span<const std::byte> content, std::size_t offset_bytes) {
    assert(offset_bytes + content.size() <= size_bytes_);
    if (content.empty()) return;
    const Context::Use use{*object_.context()};
    object_.context()->gl().NamedBufferSubData(name(), GLintptr(offset_bytes),
                                               GLsizeiptr(content.size()), content.data());
    check_errors(*object_.context(), "writing " + size_text(content.size()) + " to a buffer");
}

void Buffer::read(std::span<std::byte> content, std::size_t offset_bytes) const {
    assert(offset_bytes + content.size() <= size_bytes_);
    if (content.empty()) return;
    const Context::Use use{*object_.context()};
    object_.context()->gl().GetNamedBufferSubData(name(), GLintptr(offset_bytes),
                                                  GLsizeiptr(content.size()), content.data());
    check_errors(*object_.context(), "reading " + size_text(content.size()) + " from a buffer");
}

void Buffer::clear() {
    const Context::Use use{*object_.context()};
    object_.context()->gl().ClearNamedBufferData(name(), GL_R8UI, GL_RED_INTEGER, GL_UNSIGNED_BYTE,
                                                 nullptr);
    check_errors(*object_.context(), "clearing a buffer of " + size_text(size_bytes_));
}

}  // namespace opacity::gl
