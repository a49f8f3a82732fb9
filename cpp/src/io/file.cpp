#include "io/file.hpp"

#include <algorithm>

namespace opacity {
namespace fs = std::filesystem;

InputFile::InputFile(const fs::path& path) : name_{path.string()} {
    std::error_code failure;
    const fs::file_status status = fs::status(path, failure);
    if (!fs::exists(status)) throw error("does not exist", "check the path");
    // Pipes and devices have no size that their content could be checked against.
    if (!fs::is_regular_file(status)) throw error("is not a file", "pass the path of one file");
    size_ = fs::file_size(path, failure);
    stream_.open(path, std::ios::binary);
    if (failure || !stream_)
        throw error("cannot be opened", "check that you may read the file and its folder");
}

void InputFile::read(void* to, std::size_t bytes) {
    if (stream_.read(static_cast<char*>(to), static_cast<std::streamsize>(bytes))) return;
    throw error("ended while it was read: " + std::to_string(stream_.gcount()) + " of " +
                    std::to_string(bytes) + " bytes came",
                "check the disk, and that nobody else writes the file");
}

FileFormatError InputFile::error(const std::string& problem, const std::string& fix) const {
    return {name_ + " " + problem, fix};
}

std::string read_text(const fs::path& path) {
    InputFile file{path};
    std::string text(static_cast<std::size_t>(file.size()), '\0');
    if (!text.empty()) file.read(text.data(), text.size());
    return text;
}

std::string lower_suffix(const fs::path& path) {
    std::string suffix = path.extension().string();
    // ASCII only, whatever the locale: no supported suffix has another letter.
    std::transform(suffix.begin(), suffix.end(), suffix.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c; });
    return suffix;
}

}  // namespace opacity
