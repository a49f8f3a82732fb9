// What tests of files share: files that lie, and pictures to hang on models.
#pragma once

#include <doctest/doctest.h>

#include <cstdlib>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "opacity/core/error.hpp"
#include "opacity/io/load.hpp"
#include "scratch_folder.hpp"

template <class T>
void append(std::string& bytes, const T& value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

// The message of the FileFormatError that loading `content` gives; empty when it loads.
inline std::string refusal(const ScratchFolder& folder, const std::string& name,
                           const std::string& content) {
    const auto path = folder.write(name, content);
    return message_of<opacity::FileFormatError>([&] { opacity::load(path.string()); });
}

// A file cut anywhere is refused, with its name.
inline void check_cuts(const ScratchFolder& folder, const std::string& name,
                       const std::string& whole) {
    for (std::size_t size = 0; size < whole.size(); ++size) {
        CAPTURE(size);
        CHECK(contains(refusal(folder, name, whole.substr(0, size)), name));
    }
}

// Damaged bytes load or are refused, and never do anything else.
inline void check_damage(const ScratchFolder& folder, const std::string& name,
                         const std::string& whole) {
    std::mt19937 random{20240607};
    int refused = 0;
    constexpr int rounds = 2000;
    for (int round = 0; round < rounds; ++round) {
        std::string damaged = whole;
        for (std::uint32_t hits = 1 + random() % 4; hits > 0; --hits)
            damaged[random() % damaged.size()] = char(random() % 256);
        if (random() % 4 == 0) damaged.resize(random() % (damaged.size() + 1));
        refused += !refusal(folder, name, damaged).empty();
    }
    CHECK(refused > rounds / 10);
    CHECK(refused < rounds);
}

// All of a file's shapes, which are of one kind.
template <class Kind>
std::vector<std::shared_ptr<Kind>> all(const std::vector<opacity::ShapePtr>& shapes) {
    std::vector<std::shared_ptr<Kind>> result;
    for (const opacity::ShapePtr& shape : shapes) {
        result.push_back(std::dynamic_pointer_cast<Kind>(shape));
        REQUIRE(result.back());
    }
    return result;
}

// Real models, where this machine has them.
inline std::filesystem::path real_file(const std::string& name) {
    const char* folder = std::getenv("PYOPACITY_DATA");
    const std::filesystem::path data =
        folder ? folder
               : std::filesystem::path{OPACITY_SOURCE_DIR}.parent_path() / "shared" / "data";
    if (std::filesystem::exists(data / name)) return data / name;
    MESSAGE("skipped, no file: " << (data / name).string());
    return {};
}
