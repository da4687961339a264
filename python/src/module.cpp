// hl._hl: what the package hl has in C++: hl_batch.h, hl.h and recordings. What users see is in python/hl.
#include <pybind11/pybind11.h>

#include <cstring>

#include "base/error.h"
#include "bindings.h"
#include "errors.h"

namespace py = pybind11;

namespace {

void raise(HLenum code, const char* text) {
  // The name of a file within it need not be Unicode.
  const auto line = py::reinterpret_steal<py::object>(
      PyUnicode_DecodeUTF8(text, static_cast<py::ssize_t>(std::strlen(text)), "surrogateescape"));
  const py::object error = py::module_::import("hl.errors").attr("make")(code, line);
  PyErr_SetObject(reinterpret_cast<PyObject*>(Py_TYPE(error.ptr())), error.ptr());
}

void translate(std::exception_ptr thrown) {
  try {
    std::rethrow_exception(thrown);
  } catch (const CallFailed& error) {
    raise(error.code(), error.what());
  } catch (const hl::Error& error) {
    raise(HL_INVALID_VALUE, error.what());
  }
}

void bindAll(py::module_& module) {
  py::register_exception_translator(&translate);
  module.attr("__version__") = HL_PACKAGE_VERSION;
  bindBatch(module);
  bindCalls(module);
  bindRecordings(module);
}

py::module_::module_def definition;

}  // namespace

// PYBIND11_MODULE, and before it a question: pybind11 takes the interpreter's lock by way of the main interpreter, and
// in another one it would wait for ever.
PYBIND11_PLUGIN_IMPL(_hl) {
  if (PyInterpreterState_Get() != PyInterpreterState_Main()) {
    PyErr_SetString(PyExc_ImportError, "hl does not run in a subinterpreter: start a process of its own");
    return nullptr;
  }
  PYBIND11_CHECK_PYTHON_VERSION
  PYBIND11_ENSURE_INTERNALS_READY
  py::module_ module = py::module_::create_extension_module("_hl", nullptr, &definition);
  try {
    bindAll(module);
    return module.ptr();
  }
  PYBIND11_CATCH_INIT_EXCEPTIONS
}
