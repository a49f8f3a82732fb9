#include "io/model_folder.hpp"

#include <algorithm>

#include "io/file.hpp"

namespace opacity {
namespace fs = std::filesystem;

fs::path ModelFolder::find(std::string_view name) const {
    std::string slashes{name};
    std::replace(slashes.begin(), slashes.end(), '\\', '/');  // models from Windows
    const fs::path relative = fs::path{slashes}.lexically_normal();
    if (relative.has_root_path() || slashes.find('\0') != slashes.npos ||
        std::find(relative.begin(), relative.end(), "..") != relative.end())
        return {};
    const fs::path path = model_.parent_path() / relative;
    std::error_code failure;
    return fs::is_regular_file(path, failure) ? path : fs::path{};
}

std::shared_ptr<PictureMaps> ModelFolder::picture(std::string_view name) {
    const fs::path path = find(name);
    if (path.empty()) {
        warn_of(name, "is not in its folder");
        return nullptr;
    }
    const std::string suffix = lower_suffix(path);
    if (suffix != ".png" && suffix != ".jpg" && suffix != ".jpeg") {
        warn_of(name, "is not read: save it as PNG or JPEG");
        return nullptr;
    }
    const auto [found, is_new] = pictures_.try_emplace(path);
    if (is_new) {
        const std::string content = read_text(path);
        found->second = std::make_shared<PictureMaps>(
            decode_picture(std::as_bytes(std::span{content}), path.string()));
    }
    return found->second;
}

void ModelFolder::warn_of(std::string_view file, std::string_view problem) const {
    constexpr std::size_t longest = 200;  // a damaged name may be megabytes long
    warn(std::string{file.substr(0, longest)} + ", which the model names, " + std::string{problem});
}

void ModelFolder::warn(const std::string& message) const {
    if (log_) log_(LogLevel::warning, model_.string() + ": " + message);
}

}  // namespace opacity
