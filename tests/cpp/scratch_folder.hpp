// A folder of one test, gone with it.
#pragma once

#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <random>
#include <string>

class ScratchFolder {
   public:
    ScratchFolder() {
        std::random_device random;
        path_ =
            std::filesystem::temp_directory_path() / ("opacity_test_" + std::to_string(random()));
        std::filesystem::create_directory(path_);
    }
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;
    ~ScratchFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }

    const std::filesystem::path& path() const { return path_; }
    std::filesystem::path file(const std::string& name) const { return path_ / name; }
    std::filesystem::path write(const std::string& name, const std::string& content) const {
        std::ofstream{file(name), std::ios::binary} << content;
        return file(name);
    }
    std::size_t entries() const {
        return std::size_t(std::distance(std::filesystem::directory_iterator{path_},
                                         std::filesystem::directory_iterator{}));
    }

   private:
    std::filesystem::path path_;
};

// The problem and the fix of what `call` throws; empty when it throws nothing of this kind.
template <class Error, class Call>
std::string message_of(Call&& call) {
    try {
        call();
    } catch (const Error& error) {
        CHECK(!error.problem().empty());
        CHECK(!error.fix().empty());
        return error.what();
    }
    return {};
}

inline bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}
