// The Python module pyopacity._native, one function a noun. It is private: python/pyopacity wraps
// it in classes that check types, dtypes and shapes and say how to fix them, so that here
// everything has the right type already.
#pragma once

#include <pybind11/pybind11.h>

#include <string>

namespace opacity::bindings {

namespace py = pybind11;

void bind_errors(py::module_& module);
void bind_core(py::module_& module);
void bind_params(py::module_& module);
void bind_shapes(py::module_& module);
void bind_media(py::module_& module);
void bind_lights(py::module_& module);
void bind_scene(py::module_& module);
void bind_trace(py::module_& module);
void bind_technique(py::module_& module);
void bind_context(py::module_& module);
void bind_renderer(py::module_& module);
void bind_io(py::module_& module);

// Text that may hold bytes of a hostile file: what is not UTF-8 is replaced, not another error.
py::str text(const std::string& bytes);

// Lets Ctrl-C through after a long call that could not look for it.
inline void check_signals() {
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
}

}  // namespace opacity::bindings
