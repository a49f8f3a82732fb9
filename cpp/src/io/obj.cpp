// Wavefront OBJ: https://paulbourke.net/dataformats/obj
#include <algorithm>
#include <charconv>
#include <set>

#include "core/vector.hpp"
#include "io/file.hpp"
#include "io/model_folder.hpp"
#include "io/mtl.hpp"
#include "io/surface.hpp"
#include "io/text_cursor.hpp"
#include "io/triangles.hpp"
#include "opacity/io/load.hpp"

namespace opacity {
namespace {

namespace fs = std::filesystem;

// A point with the place on the maps and the normal that it has in one face, or `none`.
struct Corner {
    static constexpr std::uint32_t none = 0xFFFF'FFFF;
    std::uint32_t point = 0, uv = none, normal = none;
    auto operator<=>(const Corner&) const = default;
};

// The faces of one material: polygon k ends before corner ends[k].
struct Part {
    std::string material;
    std::vector<Corner> corners;
    std::vector<std::size_t> ends;
};

class ObjReader {
   public:
    ObjReader(const fs::path& path, std::string_view text, const Logger& log)
        : cursor_{path, text}, folder_{path, log} {}

    std::vector<ShapePtr> read();

   private:
    void read_statement(std::string_view keyword);
    void read_face();
    Corner read_corner(std::string_view word) const;
    std::uint32_t index(std::string_view digits, std::size_t count, const char* what) const;
    void read_materials(std::string_view names);
    bool read_material_file(std::string_view name);
    Part& current_part();
    Surface surface(const std::string& material);
    TextureMapPtr alpha_map(const Material& material, PictureMaps* colors);
    ShapePtr mesh(const Part& part);

    TextCursor cursor_;
    ModelFolder folder_;
    std::vector<double3> points_;
    std::vector<float2> uvs_;
    std::vector<float3> normals_;
    Materials materials_;
    std::set<fs::path> material_files_;
    std::string material_;
    std::vector<Part> parts_;
    std::map<std::string, std::size_t, std::less<>> part_of_;
};

std::vector<ShapePtr> ObjReader::read() {
    while (cursor_.next_statement()) read_statement(cursor_.word());
    if (parts_.empty())
        throw cursor_.error("the file ends without a face",
                            "export the model as polygons (f v v v)");
    std::vector<ShapePtr> shapes;
    for (const Part& part : parts_) shapes.push_back(mesh(part));
    return shapes;
}

// Everything else - groups, objects, smoothing, lines, points - changes no shadow.
void ObjReader::read_statement(std::string_view keyword) {
    if (keyword == "v") {
        // A weight or a colour may follow; neither moves the point.
        const double x = cursor_.number("v.x"), y = cursor_.number("v.y"),
                     z = cursor_.number("v.z");
        points_.push_back({x, y, z});
    } else if (keyword == "vt") {
        const double u = cursor_.number("vt.u");
        TextCursor ahead = cursor_;
        const double v = ahead.word().empty() ? 0.0 : cursor_.number("vt.v");
        uvs_.push_back({float(u), float(1.0 - v)});  // a file counts from the picture's bottom
    } else if (keyword == "vn") {
        const double x = cursor_.number("vn.x"), y = cursor_.number("vn.y"),
                     z = cursor_.number("vn.z");
        normals_.push_back({float(x), float(y), float(z)});
    } else if (keyword == "f") {
        read_face();
    } else if (keyword == "usemtl") {
        material_ = cursor_.rest();
    } else if (keyword == "mtllib") {
        read_materials(cursor_.rest());
    }
}

void ObjReader::read_face() {
    Part& part = current_part();
    const std::size_t begin = part.corners.size();
    for (std::string_view word = cursor_.word(); !word.empty(); word = cursor_.word())
        part.corners.push_back(read_corner(word));
    if (part.corners.size() - begin < 3)
        throw cursor_.error("a face of " + std::to_string(part.corners.size() - begin) + " corners",
                            "give every face three or more; write lines as l");
    part.ends.push_back(part.corners.size());
}

// v, v/t, v//n or v/t/n
Corner ObjReader::read_corner(std::string_view word) const {
    const std::size_t slash = word.find('/');
    Corner corner{index(word.substr(0, slash), points_.size(), "point")};
    if (slash == word.npos) return corner;
    const std::size_t second = std::min(word.find('/', slash + 1), word.size());
    const std::string_view uv = word.substr(slash + 1, second - slash - 1);
    if (!uv.empty()) corner.uv = index(uv, uvs_.size(), "texture coordinate");
    if (second == word.size()) return corner;
    const std::string_view normal = word.substr(second + 1);
    if (!normal.empty()) corner.normal = index(normal, normals_.size(), "normal");
    return corner;
}

// From 1, or negative: counted back from the last one so far.
std::uint32_t ObjReader::index(std::string_view digits, std::size_t count, const char* what) const {
    std::int64_t value = 0;
    const auto [end, failure] =
        std::from_chars(digits.data(), digits.data() + digits.size(), value);
    const bool whole = failure == std::errc{} && end == digits.data() + digits.size();
    const auto end_index = static_cast<std::int64_t>(count);
    const std::int64_t result = value > 0 ? value - 1 : end_index + value;
    const bool inside = value != 0 && result >= 0 && result < end_index && result < Corner::none;
    if (whole && inside) return static_cast<std::uint32_t>(result);
    throw cursor_.error("a face names " + std::string{what} + " \"" +
                            std::string{digits.substr(0, 40)} + "\" of " + std::to_string(count) +
                            " read so far",
                        "count from 1, or back from -1, and define points before their faces");
}

// One name, perhaps with spaces, or several.
void ObjReader::read_materials(std::string_view names) {
    if (read_material_file(names)) return;
    bool any = false;
    for (std::size_t begin = 0; begin < names.size();) {
        const std::size_t end = std::min(names.find_first_of(" \t", begin), names.size());
        if (end > begin) any |= read_material_file(names.substr(begin, end - begin));
        begin = end + 1;
    }
    if (!any) folder_.warn_of(names, "is not in its folder");
}

// False where there is none: models often travel without their .mtl, and a grey one still has its
// shadow.
bool ObjReader::read_material_file(std::string_view name) {
    const fs::path path = folder_.find(name);
    if (path.empty()) return false;
    if (material_files_.insert(path).second) read_mtl(path, materials_);
    return true;
}

Part& ObjReader::current_part() {
    const auto [found, is_new] = part_of_.try_emplace(material_, parts_.size());
    if (is_new) parts_.push_back({material_, {}, {}});
    return parts_[found->second];
}

// The faces as fans, of the places that their corners have in the sorted vertices.
std::vector<std::uint32_t> triangulated(const Part& part, const std::vector<Corner>& vertices) {
    std::vector<std::uint32_t> corners(part.corners.size()), triangles;
    std::transform(part.corners.begin(), part.corners.end(), corners.begin(), [&](const Corner& c) {
        const auto found = std::lower_bound(vertices.begin(), vertices.end(), c);
        return static_cast<std::uint32_t>(found - vertices.begin());
    });
    triangles.reserve(3 * (corners.size() - 2 * part.ends.size()));
    std::size_t begin = 0;
    for (const std::size_t end : part.ends) {
        add_fan(triangles, std::span{corners}.subspan(begin, end - begin));
        begin = end;
    }
    return triangles;
}

// Of vertices that the file has no normal for, weighted by area. A seam of the maps is no edge: the
// vertices of one point, which stand side by side, get the same.
void make_normals_across_seams(const std::vector<Corner>& vertices, const std::vector<double>& xyz,
                               const std::vector<std::uint32_t>& triangles,
                               std::vector<float3>& normals) {
    std::vector<double3> sums(vertices.size(), double3{});
    const auto point = [&](std::uint32_t v) {
        return double3{xyz[3 * v], xyz[3 * v + 1], xyz[3 * v + 2]};
    };
    for (std::size_t t = 0; t < triangles.size(); t += 3) {
        const double3 a = point(triangles[t]);
        const double3 twice_area =
            cross(minus(point(triangles[t + 1]), a), minus(point(triangles[t + 2]), a));
        for (std::size_t c = 0; c < 3; ++c)
            sums[triangles[t + c]] = plus(sums[triangles[t + c]], twice_area);
    }
    for (std::size_t begin = 0, end = 0; begin < vertices.size(); begin = end) {
        double3 sum{};
        for (end = begin; end < vertices.size() && vertices[end].point == vertices[begin].point;
             ++end)
            sum = plus(sum, sums[end]);
        const double size = length(sum);
        for (std::size_t v = begin; size > 0.0 && v < end; ++v)
            if (vertices[v].normal == Corner::none)
                for (std::size_t i = 0; i < 3; ++i) normals[v][i] = float(sum[i] / size);
    }
}

// From map_d: the channel that it names, or else the alpha channel if that says anything. Without
// one, a colour picture that has holes is taken at its word.
TextureMapPtr ObjReader::alpha_map(const Material& material, PictureMaps* colors) {
    const auto& [file, channel] = material.alpha_map;
    if (file.empty()) return colors && colors->alpha_varies() ? colors->alpha() : nullptr;
    const std::shared_ptr<PictureMaps> maps = folder_.picture(file);
    if (!maps) return nullptr;
    const bool alpha = channel == 'm' || (channel == 0 && maps->alpha_varies());
    return alpha ? maps->alpha() : maps->luminance();
}

Surface ObjReader::surface(const std::string& name) {
    const auto found = materials_.find(name);
    if (found == materials_.end()) return {};
    const Material& material = found->second;
    Surface surface;
    surface.opacity = material.opacity;
    surface.color = material.color.value_or(neutral_grey);
    std::shared_ptr<PictureMaps> colors;
    if (const std::string& file = material.color_map.file; !file.empty()) {
        colors = folder_.picture(file);
        surface.color = colors ? material.color.value_or(float3{1, 1, 1}) : neutral_grey;
        if (colors) surface.color_map = colors->color();
    }
    surface.alpha_map = alpha_map(material, colors.get());
    if (surface.alpha_map) surface.alpha_mode = AlphaMode::mask;
    return surface;
}

// One vertex for each point, place on the maps and normal that occur together. Sorted rather than
// hashed: the vertices keep the file's order, and no file, however made, is slow to read.
ShapePtr ObjReader::mesh(const Part& part) {
    std::vector<Corner> vertices = part.corners;
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    std::vector<std::uint32_t> triangles = triangulated(part, vertices);

    const auto any = [&](std::uint32_t Corner::*index) {
        return std::any_of(vertices.begin(), vertices.end(),
                           [index](const Corner& c) { return c.*index != Corner::none; });
    };
    const bool any_uv = any(&Corner::uv), any_normal = any(&Corner::normal) || any_uv;
    std::vector<double> xyz;
    std::vector<float3> normals;
    std::vector<float2> uvs;
    xyz.reserve(3 * vertices.size());
    for (const auto& [point, uv, normal] : vertices) {
        xyz.insert(xyz.end(), points_[point].begin(), points_[point].end());
        if (any_uv) uvs.push_back(uv == Corner::none ? float2{} : uvs_[uv]);
        // A zero normal asks the mesh to make it.
        if (any_normal) normals.push_back(normal == Corner::none ? float3{} : normals_[normal]);
    }
    if (any_uv) make_normals_across_seams(vertices, xyz, triangles, normals);
    const Surface look = surface(part.material);
    auto mesh =
        std::make_shared<Mesh>(Positions{std::move(xyz)}, std::move(triangles), std::move(normals),
                               std::vector{look.opacity}, std::vector{look.color});
    mesh->set_uvs(std::move(uvs));
    look.hang_maps_on(*mesh);
    return mesh;
}

}  // namespace

std::vector<ShapePtr> load_obj(const fs::path& path, const Logger& log) {
    const std::string text = read_text(path);
    return ObjReader{path, text, log}.read();
}

}  // namespace opacity
