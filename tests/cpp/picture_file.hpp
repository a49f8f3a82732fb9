// Small pictures, as the bytes of their files.
#pragma once

#include <cstdlib>
#include <string>
#include <vector>

#include "io/stb_writer.hpp"

using Texels = std::vector<unsigned char>;

inline std::string png_file(int width, int height, int channels, const Texels& texels) {
    int size = 0;
    unsigned char* bytes =
        stbi_write_png_to_mem(texels.data(), width * channels, width, height, channels, &size);
    std::string file(reinterpret_cast<char*>(bytes), std::size_t(size));
    std::free(bytes);
    return file;
}

inline std::string jpeg_file(int width, int height, int channels, const Texels& texels) {
    std::string file;
    const auto add = [](void* to, void* bytes, int size) {
        static_cast<std::string*>(to)->append(static_cast<char*>(bytes), std::size_t(size));
    };
    stbi_write_jpg_to_func(add, &file, width, height, channels, texels.data(), 95);
    return file;
}
