// C++ errors become the classes of pyopacity/errors.py, which keep `what` and `fix` apart. They are
// defined in Python because they derive from two classes: an OutOfMemoryError is an Error and a
// MemoryError.
#include "opacity/core/error.hpp"

#include <new>

#include "bindings/bindings.hpp"
#include "opacity/plugin.hpp"

namespace opacity::bindings {
namespace {

void raise(const char* type, const std::string& problem, const std::string& fix) {
    const py::object python_type = py::module_::import("pyopacity.errors").attr(type);
    const py::object error = python_type(text(problem), text(fix));
    PyErr_SetObject(python_type.ptr(), error.ptr());
}

void raise(const char* type, const Error& error) {
    raise(type, error.problem(), error.fix());
}

void translate(std::exception_ptr thrown) {
    if (!thrown) return;
    // Derived before base. What is not listed is a fault of ours, and stays what it is.
    try {
        std::rethrow_exception(thrown);
    } catch (const DeviceLostError& error) {
        raise("DeviceLostError", error);
    } catch (const ForkedContextError& error) {
        raise("ForkedContextError", error);
    } catch (const ContextError& error) {
        raise("ContextError", error);
    } catch (const ParameterError& error) {
        raise("ParameterError", error);
    } catch (const FileFormatError& error) {
        raise("FileFormatError", error);
    } catch (const ShaderError& error) {
        raise("ShaderError", error);
    } catch (const PluginError& error) {
        raise("PluginError", error);
    } catch (const OutOfMemoryError& error) {
        raise("OutOfMemoryError", error);
    } catch (const Error& error) {
        raise("Error", error);
    } catch (const std::bad_alloc&) {
        raise("OutOfMemoryError", "the machine has no memory left for this",
              "close other programs, or use a smaller scene, map or picture");
    }
}

}  // namespace

py::str text(const std::string& bytes) {
    PyObject* decoded =
        PyUnicode_DecodeUTF8(bytes.data(), static_cast<py::ssize_t>(bytes.size()), "replace");
    if (!decoded) throw py::error_already_set();
    return py::reinterpret_steal<py::str>(decoded);
}

void bind_errors(py::module_&) {
    py::register_local_exception_translator(&translate);
}

}  // namespace opacity::bindings
