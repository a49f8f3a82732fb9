#include "opacity/io/load.hpp"

#include "io/demo.hpp"
#include "io/file.hpp"
#include "opacity/core/error.hpp"

namespace opacity {
namespace {

struct Format {
    const char* suffix;
    std::vector<ShapePtr> (*load)(const std::filesystem::path&, const Logger&);
};
// Of a format that is one file, without a second that could be missing.
template <std::vector<ShapePtr> (*read)(const std::filesystem::path&)>
std::vector<ShapePtr> alone(const std::filesystem::path& path, const Logger&) {
    return read(path);
}
constexpr Format formats[] = {{".hair", alone<load_hair>}, {".obj", load_obj},
                              {".gltf", load_gltf},        {".glb", load_gltf},
                              {".ply", alone<load_ply>},   {".nrrd", alone<load_nrrd>}};

}  // namespace

std::vector<ShapePtr> load(const std::string& path_or_name, const Logger& log) {
    constexpr std::string_view demo_prefix = "demo:";
    if (path_or_name.starts_with(demo_prefix))
        return demo::load(std::string_view{path_or_name}.substr(demo_prefix.size()));
    const std::string suffix = lower_suffix(path_or_name);
    std::string list;
    for (const Format& format : formats) {
        if (suffix == format.suffix) return format.load(path_or_name, log);
        list += std::string{list.empty() ? "" : ", "} + format.suffix;
    }
    throw FileFormatError(path_or_name + " has a suffix that is not read: \"" + suffix + "\"",
                          "convert it to one of " + list + ", or pass a demo such as demo:hair");
}

}  // namespace opacity
