#include "opacity/scene/scene.hpp"

#include <algorithm>
#include <string>

#include "opacity/core/error.hpp"

namespace opacity {
namespace {

template <class Pointer>
void add_to(std::vector<Pointer>& list, Pointer item, const std::string& noun) {
    if (!item) throw ParameterError("the " + noun + " is null", "make one first, then add it");
    if (std::find(list.begin(), list.end(), item) != list.end())
        throw ParameterError("the " + noun + " is in the scene already",
                             "add it once; for a second copy make another " + noun);
    list.push_back(std::move(item));
}

template <class Pointer>
void remove_from(std::vector<Pointer>& list, const Pointer& item, const std::string& noun) {
    const auto found = std::find(list.begin(), list.end(), item);
    if (found == list.end())
        throw ParameterError("the " + noun + " is not in the scene",
                             "remove only what was added, and once");
    list.erase(found);
}

}  // namespace

void Scene::add(ShapePtr shape) {
    add_to(shapes_, std::move(shape), "shape");
}
void Scene::add(LightPtr light) {
    add_to(lights_, std::move(light), "light");
}
void Scene::remove(const ShapePtr& shape) {
    remove_from(shapes_, shape, "shape");
}
void Scene::remove(const LightPtr& light) {
    remove_from(lights_, light, "light");
}

Box Scene::bounds() const {
    Box box;
    for (const ShapePtr& shape : shapes_) box.extend(shape->bounds());
    return box;
}

bool Scene::is_tinted() const {
    return std::any_of(shapes_.begin(), shapes_.end(), [](const ShapePtr& shape) {
        const auto lock = shape->lock();
        return shape->tint() != nullptr;
    });
}

}  // namespace opacity
