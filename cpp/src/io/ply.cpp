#include <algorithm>
#include <cmath>
#include <limits>

#include "core/number_text.hpp"
#include "io/file.hpp"
#include "io/ply_body.hpp"
#include "io/spacing.hpp"
#include "io/srgb.hpp"
#include "io/triangles.hpp"
#include "opacity/io/load.hpp"
#include "opacity/scene/mesh.hpp"
#include "opacity/scene/particles.hpp"
#include "scene/check.hpp"

namespace opacity {
namespace {

constexpr Allowed coordinate{-max_coordinate, max_coordinate, "finite and at most 1e18 in size"};

// Where one attribute of the vertices stands in a row of theirs.
struct Column {
    std::size_t place;
    ScalarType type;
};

// Those of one attribute, such as x, y and z; none unless all are there.
std::vector<Column> columns(const PlyElement& element,
                            std::initializer_list<std::initializer_list<std::string_view>> names) {
    std::vector<Column> result;
    for (const auto& synonyms : names) {
        const auto place = element.find(synonyms);
        if (!place || element.properties[*place].count_type) return {};
        result.push_back({*place, element.properties[*place].type});
    }
    return result;
}

struct VertexColumns {
    explicit VertexColumns(const PlyElement& vertex)
        : point{columns(vertex, {{"x"}, {"y"}, {"z"}})},
          normal{columns(vertex, {{"nx"}, {"ny"}, {"nz"}})},
          color{columns(
              vertex,
              {{"red", "diffuse_red"}, {"green", "diffuse_green"}, {"blue", "diffuse_blue"}})},
          opacity{columns(vertex, {{"opacity", "alpha", "diffuse_alpha"}})},
          radius{columns(vertex, {{"radius", "pscale"}})} {}

    std::vector<Column> point, normal, color, opacity, radius;
};

// What a whole number that stands for 1 is stored as.
double largest(ScalarType type) {
    if (is_float(type)) return 1.0;
    return type == ScalarType::uint16 ? 65535.0 : 255.0;
}

class PlyReader {
   public:
    explicit PlyReader(const std::filesystem::path& path)
        : name_{path.string()},
          content_{read_text(path)},
          header_{read_ply_header(content_, name_)},
          body_{std::string_view{content_}.substr(header_.size), header_.encoding, name_} {}

    std::vector<ShapePtr> read();

   private:
    void read_element(const PlyElement& element);
    void read_vertices(const PlyElement& element);
    void add_vertex(const std::vector<double>& row, const VertexColumns& columns);
    void read_faces(const PlyElement& element, bool strips);
    void add_triangles(std::span<const double> corners, bool strip);
    float checked(const std::vector<double>& row, const Column& column, const Allowed& allowed,
                  double unit = 1.0) const;
    Positions positions();
    void check_triangles() const;

    std::string name_, content_;
    PlyHeader header_;
    PlyBody body_;
    std::uint64_t row_ = 0;
    const PlyElement* element_ = nullptr;
    bool wide_ = false;  // coordinates of float64
    std::vector<double> xyz_;
    std::vector<float3> normals_, colors_;
    std::vector<float> opacity_, radius_;
    std::vector<std::uint32_t> triangles_;
};

std::vector<ShapePtr> PlyReader::read() {
    for (const PlyElement& element : header_.elements) read_element(element);
    if (xyz_.empty()) throw body_.error("holds no vertices");
    check_triangles();
    Positions points = positions();
    if (!triangles_.empty()) {
        if (opacity_.empty()) opacity_ = {1.f};
        if (colors_.empty()) colors_ = {float3{0.7f, 0.7f, 0.7f}};
        return {std::make_shared<Mesh>(std::move(points), std::move(triangles_),
                                       std::move(normals_), std::move(opacity_),
                                       std::move(colors_))};
    }
    if (radius_.empty()) radius_ = {half_mean_spacing(points)};
    auto particles = std::make_shared<Particles>(std::move(points), std::move(radius_));
    if (!opacity_.empty()) particles->set_opacity(std::move(opacity_));
    if (!colors_.empty()) particles->set_color(std::move(colors_));
    return {particles};
}

void PlyReader::read_element(const PlyElement& element) {
    element_ = &element;
    body_.check_room(element);
    if (element.name == "vertex") return read_vertices(element);
    if (element.name == "face" || element.name == "tristrips")
        return read_faces(element, element.name == "tristrips");
    for (row_ = 0; row_ < element.count; ++row_)
        for (const PlyProperty& property : element.properties) body_.skip(property);
}

// A property of the row that is read, `unit` of it as 1.
float PlyReader::checked(const std::vector<double>& row, const Column& column,
                         const Allowed& allowed, double unit) const {
    const double value = row[column.place];
    if (allowed(value / unit)) return float(value / unit);
    throw body_.error("holds vertex " + std::to_string(row_) + " with " +
                      element_->properties[column.place].name.substr(0, 40) + " = " +
                      number_text(value) + ", which is not " + allowed.words +
                      (unit == 1.0 ? "" : " times " + number_text(unit)));
}

void PlyReader::read_vertices(const PlyElement& element) {
    const VertexColumns columns{element};
    if (columns.point.empty()) throw body_.error("holds vertices without x, y and z");
    wide_ = columns.point[0].type == ScalarType::float64;
    std::vector<double> row(element.properties.size());
    for (row_ = 0; row_ < element.count; ++row_) {
        for (std::size_t i = 0; i < row.size(); ++i) {
            const PlyProperty& property = element.properties[i];
            if (property.count_type)
                body_.skip(property);
            else
                row[i] = body_.next(property.type);
        }
        add_vertex(row, columns);
    }
}

void PlyReader::add_vertex(const std::vector<double>& row, const VertexColumns& columns) {
    for (const Column& column : columns.point) {
        checked(row, column, coordinate);
        xyz_.push_back(row[column.place]);
    }
    float3 vector{};
    for (std::size_t c = 0; c < columns.normal.size(); ++c)
        vector[c] = checked(row, columns.normal[c], any_finite);
    if (!columns.normal.empty()) normals_.push_back(vector);
    for (std::size_t c = 0; c < columns.color.size(); ++c) {
        const double unit = largest(columns.color[c].type);
        const bool stored = unit != 1.0;  // as a screen shows it, so in sRGB
        vector[c] = checked(row, columns.color[c], stored ? unit_interval : brightness, unit);
        if (stored) vector[c] = linear_from_srgb(vector[c]);
    }
    if (!columns.color.empty()) colors_.push_back(vector);
    for (const Column& column : columns.opacity)
        opacity_.push_back(checked(row, column, unit_interval, largest(column.type)));
    for (const Column& column : columns.radius)
        radius_.push_back(checked(row, column, not_negative));
}

void PlyReader::read_faces(const PlyElement& element, bool strips) {
    const auto place = element.find({"vertex_indices", "vertex_index"});
    const bool is_list = place && element.properties[*place].count_type;
    if (!is_list && element.count > 0)
        throw body_.error("holds faces without a list of vertex_indices");
    std::vector<double> corners;
    for (row_ = 0; row_ < element.count; ++row_)
        for (std::size_t i = 0; i < element.properties.size(); ++i) {
            const PlyProperty& property = element.properties[i];
            if (i != *place) {
                body_.skip(property);
                continue;
            }
            corners.resize(body_.next_count(property));
            for (double& corner : corners) corner = body_.next(property.type);
            add_triangles(corners, strips);
        }
}

// One polygon, or strips with -1 between them.
void PlyReader::add_triangles(std::span<const double> corners, bool strip) {
    std::vector<std::uint32_t> run;
    for (const double corner : corners) {
        if (strip && corner == -1.0) {
            add_strip(triangles_, run);
            run.clear();
            continue;
        }
        constexpr double most = std::numeric_limits<std::uint32_t>::max();
        if (!(corner >= 0.0 && corner <= most && corner == std::floor(corner)))
            throw body_.error("holds face " + std::to_string(row_) + " with the vertex " +
                              number_text(corner));
        run.push_back(std::uint32_t(corner));
    }
    if (strip) return add_strip(triangles_, run);
    if (run.size() < 3)
        throw body_.error("holds face " + std::to_string(row_) + " of " +
                          std::to_string(run.size()) + " corners");
    add_fan(triangles_, run);
}

// At the end, because faces may stand before the vertices that they name.
void PlyReader::check_triangles() const {
    const std::size_t count = xyz_.size() / 3;
    const auto bad = std::find_if(triangles_.begin(), triangles_.end(),
                                  [count](std::uint32_t corner) { return corner >= count; });
    if (bad != triangles_.end())
        throw body_.error("holds a face with vertex " + std::to_string(*bad) + " of " +
                          std::to_string(count));
}

Positions PlyReader::positions() {
    if (wide_) return Positions{std::move(xyz_)};
    return Positions{std::vector<float>(xyz_.begin(), xyz_.end())};
}

}  // namespace

std::vector<ShapePtr> load_ply(const std::filesystem::path& path) {
    return PlyReader{path}.read();
}

}  // namespace opacity
