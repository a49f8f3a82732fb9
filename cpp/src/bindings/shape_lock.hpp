// A renderer on another thread may hold a shape's lock while it copies, and its log may want the
// interpreter: so whoever waits for that lock has let go of the interpreter first.
#pragma once

#include "bindings/arrays.hpp"
#include "bindings/bindings.hpp"

namespace opacity::bindings {

template <class ShapeType, class Get>
auto copied(const ShapeType& shape, Get get) {
    const py::gil_scoped_release release;
    const auto held = shape.lock();
    return get(shape);
}

template <class Call>
void without_interpreter(Call call) {
    const py::gil_scoped_release release;
    call();
}

}  // namespace opacity::bindings
