// The numbers behind a PLY file's header, one after another.
#pragma once

#include <string>
#include <string_view>

#include "io/ply_header.hpp"
#include "opacity/core/error.hpp"

namespace opacity {

class PlyBody {
   public:
    PlyBody(std::string_view content, PlyEncoding encoding, std::string name)
        : content_{content}, encoding_{encoding}, name_{std::move(name)} {}

    // The next number; FileFormatError at the end, or where text is none. Text need not keep to the
    // range of the type.
    double next(ScalarType type);
    // The length of a list, which is at most what the rest of the file can hold.
    std::size_t next_count(const PlyProperty& list);
    void skip(const PlyProperty& property);

    // Before anything is allocated: FileFormatError where the elements need more bytes than are
    // left, each at its least.
    void check_room(const PlyElement& element) const;
    FileFormatError error(const std::string& problem) const;

   private:
    std::size_t least_size(const PlyProperty& property) const;
    std::size_t least_size(ScalarType type) const;

    std::string_view content_;
    PlyEncoding encoding_;
    std::string name_;
    std::size_t at_ = 0;
};

}  // namespace opacity
