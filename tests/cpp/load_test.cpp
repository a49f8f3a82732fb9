#include <doctest/doctest.h>

#include "load_help.hpp"
#include "opacity/scene/mesh.hpp"
#include "opacity/scene/particles.hpp"
#include "opacity/scene/volume.hpp"

using namespace opacity;
using doctest::Approx;

TEST_CASE("what is not a readable file is refused by name") {
    const ScratchFolder folder;
    for (const char* suffix : {".hair", ".obj", ".gltf", ".glb", ".ply", ".nrrd"}) {
        const auto missing = folder.file(std::string{"missing"} + suffix);
        const std::string message = message_of<FileFormatError>([&] { load(missing.string()); });
        CHECK(contains(message, "does not exist"));
        CHECK(contains(message, missing.string()));
        const auto directory = folder.file(std::string{"folder"} + suffix);
        std::filesystem::create_directory(directory);
        CHECK(
            contains(message_of<FileFormatError>([&] { load(directory.string()); }), "not a file"));
        CHECK(!refusal(folder, std::string{"empty"} + suffix, "").empty());
    }
    CHECK(contains(refusal(folder, "a.fbx", "x"), ".hair, .obj, .gltf, .glb, .ply, .nrrd"));
    CHECK(contains(message_of<FileFormatError>([] { load(""); }),
                   ".hair, .obj, .gltf, .glb, .ply, .nrrd"));
}

TEST_CASE("real models are what their index says") {
    struct Model {
        const char* name;
        std::size_t parts, triangles;
    };
    for (const Model& model :
         {Model{"opaque/bear_body.obj", 1, 57'784}, Model{"opaque/ponytail_head.obj", 1, 17'894},
          Model{"opaque/bunny.ply", 1, 69'451}, Model{"opaque/teapot.ply", 1, 2'256},
          Model{"foliage/cs_selfshadow_tree.obj", 2, 3'702},
          Model{"foliage/cs_selfshadow_plant.obj", 1, 9'884},
          Model{"foliage/cs_terrainf_tree.obj", 2, 712},
          Model{"foliage/eztree_oak_large.obj", 2, 22'566},
          Model{"foliage/urtica_dioica_1.obj", 3, 12'159},
          Model{"foliage/sanmiguel_tree_a_leaves.glb", 3, 151'981}}) {
        const auto path = real_file(model.name);
        if (path.empty()) continue;
        CAPTURE(model.name);
        std::size_t triangles = 0;
        const auto meshes = all<Mesh>(load(path.string()));
        for (const auto& mesh : meshes) triangles += mesh->triangles().size() / 3;
        CHECK(meshes.size() == model.parts);
        CHECK(triangles == model.triangles);
    }
}

TEST_CASE("real particles and volumes are what their index says") {
    if (const auto path = real_file("volume/lidar_mixed_conifer_37657.ply"); !path.empty()) {
        const auto forest = all<Particles>(load(path.string())).at(0);
        CHECK(forest->points().size() == 37'657);
        CHECK(forest->radius().size() == 1);
    }
    if (const auto path = real_file("volume/openvdb_smoke_111x222x112.nrrd"); !path.empty()) {
        const auto smoke = all<Volume>(load(path.string())).at(0);
        CHECK(smoke->size_zyx() == Volume::Size{112, 222, 111});
        CHECK(smoke->max_extinction() == Approx(5.7).epsilon(0.01));
        CHECK(smoke->spacing()[1] == Approx(0.476).epsilon(0.001));
    }
    if (const auto path = real_file("volume/les_stratocumulus_64x64x16.nrrd"); !path.empty()) {
        const auto cloud = all<Volume>(load(path.string())).at(0);
        CHECK(cloud->voxel_count() == 65'536);
        CHECK(cloud->origin() == double3{0, 0, 0.438});
    }
}
