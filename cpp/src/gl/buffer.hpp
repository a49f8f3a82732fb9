// A buffer with immutable storage; another size is another Buffer.
#pragma once

#include <cstddef>
#include <memory>
#include <span>

#include "gl/object.hpp"

namespace opacity::gl {

class Buffer {
   public:
    Buffer() = default;
    // `data` may be null: the content is then undefined. OutOfMemoryError.
    Buffer(std::shared_ptr<Context> context, std::size_t size_bytes, const void* data = nullptr);

    GLuint name() const noexcept { return object_.name(); }
    std::size_t size_bytes() const noexcept { return size_bytes_; }

    void write(std::span<const std::byte> content, std::size_t offset_bytes = 0);
    void read(std::span<std::byte> content, std::size_t offset_bytes = 0) const;
    // All bytes zero.
    void clear();

   private:
    BufferObject object_;
    std::size_t size_bytes_ = 0;
};

}  // namespace opacity::gl
