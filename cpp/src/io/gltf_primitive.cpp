#include "io/gltf_primitive.hpp"

#include <algorithm>
#include <numeric>

#include "io/spacing.hpp"
#include "io/triangles.hpp"
#include "opacity/scene/particles.hpp"

namespace opacity {
namespace {

enum Mode : std::uint64_t { points, lines, line_loop, line_strip, triangles, strip, fan };

constexpr const char* repair = "repair the file, or export it again";

class PrimitiveReader {
   public:
    PrimitiveReader(GltfFile& file, const JsonValue& primitive, const GltfMaterial& material)
        : file_{file}, primitive_{primitive}, material_{material}, surface_{material.surface} {}

    ShapePtr mesh(std::uint64_t mode);
    ShapePtr particles();

   private:
    void read_corners();
    GltfAccessor attribute(const std::string& name, std::size_t least, std::size_t most) const;
    template <class Vector>
    std::vector<Vector> vectors(const GltfAccessor& accessor) const;
    Positions positions() const;
    std::vector<float2> uvs() const;
    void read_colors();

    GltfFile& file_;
    const JsonValue& primitive_;
    const GltfMaterial& material_;
    const Surface& surface_;
    GltfAccessor position_;
    // Exporters let many primitives share one list of vertices: only those in use are taken.
    std::vector<std::uint32_t> corners_, used_;
    std::vector<float3> color_;
    std::vector<float> opacity_;
};

// Nothing where the primitive has none of this name.
GltfAccessor PrimitiveReader::attribute(const std::string& name, std::size_t least,
                                        std::size_t most) const {
    const JsonValue index = primitive_["attributes"][name.c_str()];
    if (!index) return {};
    const GltfAccessor accessor = file_.accessor(index);
    if (accessor.components < least || accessor.components > most)
        throw index.error("has elements of " + std::to_string(accessor.components) + " numbers",
                          repair);
    if (position_.data && accessor.count != position_.count)
        throw index.error("has " + std::to_string(accessor.count) + " elements for " +
                              std::to_string(position_.count) + " positions",
                          repair);
    return accessor;
}

void PrimitiveReader::read_corners() {
    position_ = attribute("POSITION", 3, 3);
    const JsonValue index = primitive_["indices"];
    const GltfAccessor indices = index ? file_.accessor(index) : GltfAccessor{};
    if (indices.components != 1 || (index && is_float(indices.type)))
        throw index.error("does not hold whole numbers", repair);
    const std::size_t count = index ? indices.count : position_.count;
    constexpr std::uint64_t corner_bytes = 8, vertex_bytes = 64;
    file_.spend(corner_bytes * count);
    corners_.resize(count);
    std::iota(corners_.begin(), corners_.end(), 0u);
    for (std::size_t i = 0; index && i < count; ++i) {
        const double corner = indices.value(i, 0);
        if (!(corner >= 0.0 && corner < double(position_.count)))
            throw index.error("names vertex " + std::to_string(std::int64_t(corner)) + " of " +
                                  std::to_string(position_.count),
                              repair);
        corners_[i] = std::uint32_t(corner);
    }
    used_ = corners_;
    std::sort(used_.begin(), used_.end());
    used_.erase(std::unique(used_.begin(), used_.end()), used_.end());
    file_.spend(vertex_bytes * used_.size());
    for (std::uint32_t& corner : corners_)
        corner =
            std::uint32_t(std::lower_bound(used_.begin(), used_.end(), corner) - used_.begin());
}

template <class Vector>
std::vector<Vector> PrimitiveReader::vectors(const GltfAccessor& accessor) const {
    std::vector<Vector> result(accessor.data ? used_.size() : 0);
    for (std::size_t i = 0; i < result.size(); ++i)
        for (std::size_t c = 0; c < result[i].size(); ++c)
            result[i][c] = float(accessor.value(used_[i], c));
    return result;
}

Positions PrimitiveReader::positions() const {
    std::vector<float> xyz;
    xyz.reserve(3 * used_.size());
    for (const std::uint32_t vertex : used_)
        for (std::size_t c = 0; c < 3; ++c) xyz.push_back(float(position_.value(vertex, c)));
    return Positions{std::move(xyz)};
}

std::vector<float2> PrimitiveReader::uvs() const {
    const std::string name = "TEXCOORD_" + std::to_string(material_.uv_set);
    std::vector<float2> uvs = vectors<float2>(attribute(name, 2, 2));
    const std::array<double, 6>& m = material_.uv_transform;
    for (float2& uv : uvs)
        uv = {float(m[0] * uv[0] + m[1] * uv[1] + m[2]), float(m[3] * uv[0] + m[4] * uv[1] + m[5])};
    return uvs;
}

// The material's, times what the vertices have.
void PrimitiveReader::read_colors() {
    color_ = {surface_.color};
    opacity_ = {surface_.opacity};
    const GltfAccessor accessor = attribute("COLOR_0", 3, 4);
    if (!accessor.data || used_.empty()) return;
    color_ = vectors<float3>(accessor);
    for (float3& color : color_)
        for (std::size_t c = 0; c < 3; ++c) color[c] *= surface_.color[c];
    if (accessor.components < 4 || surface_.alpha_mode != AlphaMode::blend) return;
    opacity_.clear();
    for (const std::uint32_t vertex : used_)
        opacity_.push_back(float(accessor.value(vertex, 3)) * surface_.opacity);
}

ShapePtr PrimitiveReader::mesh(std::uint64_t mode) {
    read_corners();
    read_colors();
    std::vector<std::uint32_t> list;
    if (mode == Mode::strip) add_strip(list, corners_);
    if (mode == Mode::fan) add_fan(list, corners_);
    if (mode == Mode::triangles) {
        corners_.resize(corners_.size() / 3 * 3);
        list = std::move(corners_);
    }
    auto mesh = std::make_shared<Mesh>(positions(), std::move(list),
                                       vectors<float3>(attribute("NORMAL", 3, 3)),
                                       std::move(opacity_), std::move(color_));
    mesh->set_uvs(uvs());
    surface_.hang_maps_on(*mesh);
    return mesh;
}

ShapePtr PrimitiveReader::particles() {
    read_corners();
    read_colors();
    Positions centers = positions();
    const float radius = half_mean_spacing(centers);
    return std::make_shared<Particles>(std::move(centers), std::vector{radius}, std::move(opacity_),
                                       std::move(color_));
}

}  // namespace

ShapePtr read_gltf_primitive(GltfFile& file, const JsonValue& primitive,
                             const GltfMaterial& material) {
    const JsonValue mode = primitive["mode"];
    const std::uint64_t value = mode.whole_number(Mode::triangles);
    if (value > Mode::fan) throw mode.error("is not in 0..6", repair);
    PrimitiveReader reader{file, primitive, material};
    try {
        if (value == Mode::points) return reader.particles();
        return value >= Mode::triangles ? reader.mesh(value) : nullptr;
    } catch (const ParameterError& error) {  // values that no shape can have, such as NaN
        throw primitive.error("holds what cannot be shown: " + error.problem(), repair);
    }
}

}  // namespace opacity
