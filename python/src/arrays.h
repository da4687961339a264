// numpy arrays as HL takes them: rows of doubles, C order. What has another type is converted; shapes are checked here.
#pragma once

#include <hl/hl_types.h>
#include <pybind11/numpy.h>

#include <optional>
#include <string>

#include "errors.h"

using Doubles = pybind11::array_t<double, pybind11::array::c_style | pybind11::array::forcecast>;
using Indices = pybind11::array_t<HLuint, pybind11::array::c_style | pybind11::array::forcecast>;

inline std::string shapeText(const pybind11::array& array) {
  std::string text = "(";
  for (pybind11::ssize_t i = 0; i < array.ndim(); ++i) text += (i > 0 ? ", " : "") + std::to_string(array.shape(i));
  return text + ")";
}

/// The number of rows of an array of shape (n, `columns`).
inline std::size_t rowsOf(const pybind11::array& array, pybind11::ssize_t columns, const char* name) {
  if (array.ndim() != 2 || array.shape(1) != columns)
    throw CallFailed(HL_INVALID_VALUE, std::string(name) + " must have the shape (n, " + std::to_string(columns) +
                                           "), and has " + shapeText(array));
  return static_cast<std::size_t>(array.shape(0));
}

/// Those of an array that may be left out, which must be as many as `rows`.
inline const double* rowsOrNone(const std::optional<Doubles>& array, std::size_t rows, pybind11::ssize_t columns,
                                const char* name) {
  if (!array) return nullptr;
  if (rowsOf(*array, columns, name) != rows)
    throw CallFailed(HL_INVALID_VALUE, std::string(name) + " must have one row for each vertex");
  return array->data();
}

inline Doubles emptyRows(std::size_t rows, pybind11::ssize_t columns) {
  return Doubles({static_cast<pybind11::ssize_t>(rows), columns});
}
