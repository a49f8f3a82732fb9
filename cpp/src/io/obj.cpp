// Wavefront OBJ: https://paulbourke.net/dataformats/obj
#include <algorithm>
#include <charconv>
#include <set>

#include "io/file.hpp"
#include "io/mtl.hpp"
#include "io/text_cursor.hpp"
#include "opacity/io/load.hpp"
#include "opacity/scene/mesh.hpp"

namespace opacity {
namespace {

namespace fs = std::filesystem;

// A point with the normal that it has in one face; without one the normal is `none`.
struct Corner {
    static constexpr std::uint32_t none = 0xFFFF'FFFF;
    std::uint32_t point = 0, normal = none;
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
    ObjReader(const fs::path& path, std::string_view text)
        : cursor_{path, text}, folder_{path.parent_path()} {}

    std::vector<ShapePtr> read();

   private:
    void read_statement(std::string_view keyword);
    void read_face();
    Corner read_corner(std::string_view word) const;
    std::uint32_t index(std::string_view digits, std::size_t count, const char* what) const;
    void read_materials(std::string_view names);
    bool read_material_file(std::string_view name);
    Part& current_part();
    ShapePtr mesh(Part part) const;

    TextCursor cursor_;
    fs::path folder_;
    std::vector<double3> points_;
    std::vector<float3> normals_;
    Materials materials_;
    std::set<std::string, std::less<>> material_files_;
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
    for (Part& part : parts_) shapes.push_back(mesh(std::move(part)));
    return shapes;
}

// Everything else - texture coordinates, groups, objects, smoothing, lines, points - changes no
// shadow.
void ObjReader::read_statement(std::string_view keyword) {
    if (keyword == "v") {
        // A weight or a colour may follow; neither moves the point.
        const double x = cursor_.number("v.x"), y = cursor_.number("v.y"),
                     z = cursor_.number("v.z");
        points_.push_back({x, y, z});
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
    const std::size_t second = word.find('/', slash + 1);
    if (second == word.npos) return corner;
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
    for (std::size_t begin = 0; begin < names.size();) {
        const std::size_t end = std::min(names.find_first_of(" \t", begin), names.size());
        if (end > begin) read_material_file(names.substr(begin, end - begin));
        begin = end + 1;
    }
}

// False where there is none: models often travel without their .mtl, and a grey one still has its
// shadow. Only the model's own folder is looked into, so that a model from elsewhere cannot open
// other files.
bool ObjReader::read_material_file(std::string_view name) {
    const fs::path relative{name};
    if (relative.has_root_path() ||
        std::find(relative.begin(), relative.end(), "..") != relative.end())
        return false;
    if (material_files_.contains(name)) return true;
    std::error_code failure;
    if (!fs::is_regular_file(folder_ / relative, failure)) return false;
    material_files_.emplace(name);
    read_mtl(folder_ / relative, materials_);
    return true;
}

Part& ObjReader::current_part() {
    const auto [found, is_new] = part_of_.try_emplace(material_, parts_.size());
    if (is_new) parts_.push_back({material_, {}, {}});
    return parts_[found->second];
}

// A fan around its first corner for each polygon.
std::vector<std::uint32_t> triangulated(const Part& part, const std::vector<Corner>& vertices) {
    const auto vertex = [&](std::size_t corner) {
        const auto found = std::lower_bound(vertices.begin(), vertices.end(), part.corners[corner]);
        return static_cast<std::uint32_t>(found - vertices.begin());
    };
    std::vector<std::uint32_t> triangles;
    triangles.reserve(3 * (part.corners.size() - 2 * part.ends.size()));
    std::size_t begin = 0;
    for (const std::size_t end : part.ends) {
        const std::uint32_t first = vertex(begin);
        std::uint32_t last = vertex(begin + 1);
        for (std::size_t corner = begin + 2; corner < end; ++corner) {
            const std::uint32_t next = vertex(corner);
            triangles.insert(triangles.end(), {first, last, next});
            last = next;
        }
        begin = end;
    }
    return triangles;
}

// One vertex for each point and normal that occur together. Sorted rather than hashed: the vertices
// keep the file's order, and no file, however made, is slow to read.
ShapePtr ObjReader::mesh(Part part) const {
    std::vector<Corner> vertices = part.corners;
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    std::vector<std::uint32_t> triangles = triangulated(part, vertices);

    std::vector<double> xyz;
    std::vector<float3> normals;
    xyz.reserve(3 * vertices.size());
    const bool any_normal = std::any_of(vertices.begin(), vertices.end(),
                                        [](const Corner& c) { return c.normal != Corner::none; });
    for (const Corner& corner : vertices) {
        const double3& point = points_[corner.point];
        xyz.insert(xyz.end(), point.begin(), point.end());
        // A zero normal asks the mesh to make it.
        if (any_normal)
            normals.push_back(corner.normal == Corner::none ? float3{} : normals_[corner.normal]);
    }
    const auto material = materials_.find(part.material);
    const Material look = material == materials_.end() ? Material{} : material->second;
    return std::make_shared<Mesh>(Positions{std::move(xyz)}, std::move(triangles),
                                  std::move(normals), std::vector{look.opacity},
                                  std::vector{look.color});
}

}  // namespace

std::vector<ShapePtr> load_obj(const fs::path& path) {
    const std::string text = read_text(path);
    return ObjReader{path, text}.read();
}

}  // namespace opacity
