// hl._hl: what the package hl has in C++: hl_batch.h, hl.h and recordings. What users see is in python/hl.
#include <pybind11/pybind11.h>

#include "base/error.h"
#include "bindings.h"
#include "errors.h"

namespace py = pybind11;

namespace {

void raise(HLenum code, const char* text) {
  const py::object error = py::module_::import("hl.errors").attr("make")(code, text);
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

}  // namespace

PYBIND11_MODULE(_hl, module) {
  py::register_exception_translator(&translate);
  module.attr("__version__") = HL_PACKAGE_VERSION;
  bindBatch(module);
  bindCalls(module);
  bindRecordings(module);
}
