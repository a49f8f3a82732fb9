// The files that a model names. Only its own folder is looked into, and what lies below it, so that
// a model from elsewhere cannot open other files.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <string_view>

#include "io/picture_maps.hpp"
#include "opacity/core/log.hpp"

namespace opacity {

class ModelFolder {
   public:
    ModelFolder(const std::filesystem::path& model, Logger log)
        : model_{model}, log_{std::move(log)} {}

    // The path of a file that is there; empty where it is not, or lies elsewhere.
    std::filesystem::path find(std::string_view name) const;
    // Null, with a warning, where the picture is not there or of a format that is not read; a
    // FileFormatError where it is damaged.
    std::shared_ptr<PictureMaps> picture(std::string_view name);

    // `file`, which the model names, `has what it has`.
    void warn_of(std::string_view file, std::string_view problem) const;
    void warn(const std::string& message) const;

   private:
    std::filesystem::path model_;
    Logger log_;
    std::map<std::filesystem::path, std::shared_ptr<PictureMaps>> pictures_;
};

}  // namespace opacity
