#include <map>

#include "io/gltf_nodes.hpp"
#include "io/gltf_primitive.hpp"
#include "opacity/io/load.hpp"

namespace opacity {
namespace {

// What several primitives or nodes name is read once.
class GltfReader {
   public:
    GltfReader(const std::filesystem::path& path, const Logger& log)
        : folder_{path, log}, file_{path, folder_} {}

    std::vector<ShapePtr> read();

   private:
    const std::vector<ShapePtr>& mesh(const JsonValue& index);
    const GltfMaterial& material(const JsonValue& index);
    void place(const ShapePtr& shape, const GltfPlacement& placement,
               std::vector<ShapePtr>& shapes) const;

    ModelFolder folder_;
    GltfFile file_;
    std::map<std::uint64_t, std::vector<ShapePtr>> meshes_;
    std::map<std::uint64_t, GltfMaterial> materials_;
    GltfMaterial no_material_ = read_gltf_material(file_, {nullptr, ""});
};

std::vector<ShapePtr> GltfReader::read() {
    constexpr std::uint64_t instance_bytes = 1024;
    std::vector<ShapePtr> shapes;
    for (const GltfPlacement& placement : gltf_placements(file_)) {
        const std::vector<ShapePtr>& originals = mesh(placement.mesh);
        file_.spend(instance_bytes * originals.size());
        for (const ShapePtr& original : originals) place(original, placement, shapes);
    }
    if (shapes.empty())
        throw file_.root().error("shows neither triangles nor points",
                                 "export the model as triangles, in a scene");
    return shapes;
}

// Each node shows instances, so that its transform is its own and the content is shared.
void GltfReader::place(const ShapePtr& shape, const GltfPlacement& placement,
                       std::vector<ShapePtr>& shapes) const {
    const ShapePtr instance = shape->instance();
    try {
        instance->set_transform(placement.transform);
        shapes.push_back(instance);
    } catch (const ParameterError& error) {  // scaled to nothing, as hidden nodes are
        folder_.warn(placement.mesh.where() + " is left out: " + error.problem());
    }
}

const std::vector<ShapePtr>& GltfReader::mesh(const JsonValue& index) {
    const auto [found, is_new] = meshes_.try_emplace(index.whole_number());
    if (!is_new) return found->second;
    const JsonValue primitives = file_.item("meshes", index)["primitives"];
    for (std::size_t i = 0; i < primitives.size(); ++i) {
        const JsonValue primitive = primitives[i];
        if (ShapePtr shape = read_gltf_primitive(file_, primitive, material(primitive["material"])))
            found->second.push_back(std::move(shape));
        else
            folder_.warn(primitive.where() + " is left out: lines have no width");
    }
    return found->second;
}

const GltfMaterial& GltfReader::material(const JsonValue& index) {
    if (!index) return no_material_;
    const auto found = materials_.find(index.whole_number());
    if (found != materials_.end()) return found->second;
    return materials_[index.whole_number()] = read_gltf_material(file_, index);
}

}  // namespace

std::vector<ShapePtr> load_gltf(const std::filesystem::path& path, const Logger& log) {
    return GltfReader{path, log}.read();
}

}  // namespace opacity
