// The generated scenes of load("demo:NAME?option=value"): each is one file, demo_NAME.cpp, with its
// declaration here and its line in the table of demo.cpp. The same request makes the same bits on
// every machine.
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "opacity/scene/shape.hpp"

namespace opacity::demo {

// What somebody asks for, in range.
struct Request {
    std::size_t count, usual;  // of the scene's primitives: segments, leaves, voxels, ...
    unsigned seed;
    std::string_view style = {};  // of a scene that has styles

    // A factor for the size of each, so that any number covers about as much as the usual one.
    double size(double least, double most) const;
};

// hair?segments=1000000&seed=7; ParameterError for a name or a value that is none.
std::vector<ShapePtr> load(std::string_view request);

// What the count is of comes first, the ground last.
std::vector<ShapePtr> hair(const Request& request);
std::vector<ShapePtr> fur(const Request& request);
std::vector<ShapePtr> grass(const Request& request);
std::vector<ShapePtr> dense_grass(const Request& request);
std::vector<ShapePtr> tree(const Request& request);
std::vector<ShapePtr> sparse_tree(const Request& request);
std::vector<ShapePtr> smoke(const Request& request);
std::vector<ShapePtr> clouds(const Request& request);
std::vector<ShapePtr> plume(const Request& request);
std::vector<ShapePtr> teapot(const Request& request);
std::vector<ShapePtr> mixed(const Request& request);

}  // namespace opacity::demo
