// Files as they are read: every way in which opening or reading one fails is a FileFormatError.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

#include "opacity/core/error.hpp"

namespace opacity {

class InputFile {
   public:
    explicit InputFile(const std::filesystem::path& path);

    std::uint64_t size() const { return size_; }
    void read(void* to, std::size_t bytes);
    // "straight.hair <problem>", with the way to put it right.
    FileFormatError error(const std::string& problem, const std::string& fix) const;

   private:
    std::string name_;
    std::ifstream stream_;
    std::uint64_t size_ = 0;
};

std::string read_text(const std::filesystem::path& path);

// ".obj" for "Bear.OBJ".
std::string lower_suffix(const std::filesystem::path& path);

}  // namespace opacity
