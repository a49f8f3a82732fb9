#include "io/gltf_nodes.hpp"

#include <cmath>
#include <glm/glm.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <set>

#include "core/glm_matrix.hpp"

namespace opacity {
namespace {

constexpr const char* repair = "repair the file, or export it again";

// Of the columns of a rotation by a unit quaternion x y z w, each scaled.
glm::dmat4 rotated_and_scaled(const JsonValue& node) {
    const JsonValue rotation = node["rotation"];
    auto [x, y, z, w] = rotation.numbers<4>({0, 0, 0, 1});
    const double length = std::sqrt(x * x + y * y + z * z + w * w);
    if (!(length > 0.0)) throw rotation.error("is 0", repair);
    x /= length, y /= length, z /= length, w /= length;
    const auto [sx, sy, sz] = node["scale"].numbers<3>({1, 1, 1});
    glm::dmat4 m{1.0};
    m[0] = sx * glm::dvec4{1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y), 0};
    m[1] = sy * glm::dvec4{2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x), 0};
    m[2] = sz * glm::dvec4{2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y), 0};
    return m;
}

glm::dmat4 local_transform(const JsonValue& node) {
    if (const JsonValue matrix = node["matrix"])
        return glm::make_mat4(matrix.numbers<16>({}).data());  // by columns, as GLM has them
    glm::dmat4 m = rotated_and_scaled(node);
    const auto [x, y, z] = node["translation"].numbers<3>({0, 0, 0});
    m[3] = {x, y, z, 1};
    return m;
}

struct Visit {
    std::size_t node;
    glm::dmat4 parent;
};

// Backwards, because the last one is visited first.
void add_visits(std::vector<Visit>& visits, const GltfFile& file, const JsonValue& list,
                const glm::dmat4& parent) {
    for (std::size_t i = list.size(); i > 0; --i)
        visits.push_back({file.index_of("nodes", list[i - 1]), parent});
}

// The nodes of the scene; without one, those that no other node has as its child.
std::vector<Visit> first_visits(const GltfFile& file) {
    const JsonValue chosen = file.root()["scene"], scenes = file.root()["scenes"];
    const glm::dmat4 world{1.0};
    std::vector<Visit> visits;
    if (scenes.size() > 0) {
        const JsonValue scene = chosen ? file.item("scenes", chosen) : scenes[std::size_t{0}];
        add_visits(visits, file, scene["nodes"], world);
        return visits;
    }
    const JsonValue nodes = file.root()["nodes"];
    std::set<std::uint64_t> children;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        const JsonValue list = nodes[i]["children"];
        for (std::size_t k = 0; k < list.size(); ++k) children.insert(list[k].whole_number());
    }
    for (std::size_t i = nodes.size(); i > 0; --i)
        if (!children.contains(i - 1)) visits.push_back({i - 1, world});
    return visits;
}

}  // namespace

// Without recursion: a chain of nodes may be as long as the file.
std::vector<GltfPlacement> gltf_placements(const GltfFile& file) {
    const JsonValue nodes = file.root()["nodes"];
    std::vector<Visit> visits = first_visits(file);
    std::vector<bool> seen(nodes.size(), false);
    std::vector<GltfPlacement> placements;
    while (!visits.empty()) {
        const Visit visit = visits.back();
        visits.pop_back();
        const JsonValue node = nodes[visit.node];
        if (seen[visit.node]) throw node.error("has two parents", repair);
        seen[visit.node] = true;
        const glm::dmat4 transform = visit.parent * local_transform(node);
        if (const JsonValue mesh = node["mesh"]) placements.push_back({mesh, from_glm(transform)});
        add_visits(visits, file, node["children"], transform);
    }
    return placements;
}

}  // namespace opacity
