// Shapes from files, and generated ones.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "opacity/core/image.hpp"
#include "opacity/core/log.hpp"
#include "opacity/scene/shape.hpp"

namespace opacity {

// A .hair, .obj, .gltf, .glb, .ply or .nrrd file, or a generated scene: "demo:NAME", with options
// as in "demo:hair?segments=1000000&style=curly&seed=7". FileFormatError for a file that lies about
// its content; memory never far exceeds the file's size, or that of the pictures it names. What a
// model lacks without harm, such as a picture, is a warning.
std::vector<ShapePtr> load(const std::string& path_or_name, const Logger& log = {});

// cyHair strands: transparency t becomes opacity 1 - t, thickness the width.
std::vector<ShapePtr> load_hair(const std::filesystem::path& path);
// One mesh for each material in use, so that translucent and opaque parts stay apart; polygons
// become fans. Of the .mtl, colour (Kd, map_Kd) and opacity (d, Tr, map_d) are read. A map_d, or a
// map_Kd with holes in its alpha channel, is a mask with the cutoff .5. A surface whose picture is
// missing is grey. Only files in the model's own folder are opened.
std::vector<ShapePtr> load_obj(const std::filesystem::path& path, const Logger& log = {});
// glTF 2.0, .gltf or .glb: each node's meshes at rest as instances with its transform, points as
// particles. Of a material, base colour and alpha. An extension that the file requires and that is
// not read is an error that names it; so are sparse accessors.
std::vector<ShapePtr> load_gltf(const std::filesystem::path& path, const Logger& log = {});
// A mesh where there are faces, with the normals, colours and opacities that its vertices have;
// else particles, whose radius without one in the file is half the mean distance to the next point.
// Colours that are whole numbers are sRGB, others linear.
std::vector<ShapePtr> load_ply(const std::filesystem::path& path);
// Three axes of scalars, raw or gzip, attached to their header: extinction as the file has it.
// Axes that are turned, mirrored or slanted are the volume's transform.
std::vector<ShapePtr> load_nrrd(const std::filesystem::path& path);

// What "demo:" can be followed by.
std::vector<std::string> demo_names();

// Hair over a head on a ground, in this order, in centimetres with z up; the same for the same seed
// on every machine. The ground does not cast.
std::vector<ShapePtr> demo_hair(std::size_t segments = 150'000, unsigned seed = 1);

// An 8-bit sRGB PNG with straight alpha; written beside the target first, so that no half file is
// ever left. ParameterError where the picture is empty or the path cannot be written.
void save_png(const std::filesystem::path& path, const Image& image);

}  // namespace opacity
