// The parts of hl._hl, each in a source file of its name.
#pragma once

#include <pybind11/pybind11.h>

void bindBatch(pybind11::module_& module);
void bindCalls(pybind11::module_& module);
void bindRecordings(pybind11::module_& module);
