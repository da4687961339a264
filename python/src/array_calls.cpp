// The calls of hl.h that take or return arrays and texts: numpy arrays in place of pointers and sizes.
#include <hl/hl.hpp>

#include <array>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "arrays.h"
#include "calls.h"

namespace py = pybind11;

namespace {

using Bytes = py::array_t<HLubyte, py::array::c_style | py::array::forcecast>;
using Floats = py::array_t<HLfloat, py::array::c_style | py::array::forcecast>;
using Optional = std::optional<Doubles>;

/// What hl.h counts by 32 bits.
HLsizei sizeOf(std::size_t count, const char* name) {
  if (count > static_cast<std::size_t>(std::numeric_limits<HLsizei>::max()))
    throw CallFailed(HL_INVALID_VALUE, std::string("too many ") + name);
  return static_cast<HLsizei>(count);
}

hl::VertexArrays<HLdouble> arraysOf(const Doubles& vertices, const Optional& normals, const Optional& texcoords) {
  const std::size_t count = rowsOf(vertices, 3, "vertices");
  sizeOf(count, "vertices");
  const double* const normal = rowsOrNone(normals, count, 3, "normals");
  const double* const texcoord = rowsOrNone(texcoords, count, 2, "texcoords");
  return {{vertices.data(), 3 * count},
          {normal, normal != nullptr ? 3 * count : 0},
          {texcoord, texcoord != nullptr ? 2 * count : 0}};
}

void drawArrays(HLenum mode, const Doubles& vertices, const Optional& normals, const Optional& texcoords) {
  requireContext();
  hl::drawArrays(mode, arraysOf(vertices, normals, texcoords));
  throwFailure();
}

void drawElements(HLenum mode, const Doubles& vertices, const Indices& indices, const Optional& normals,
                  const Optional& texcoords) {
  requireContext();
  const auto arrays = arraysOf(vertices, normals, texcoords);
  const std::span<const HLuint> all(indices.data(), static_cast<std::size_t>(indices.size()));
  sizeOf(all.size(), "indices");
  try {
    hl::drawElements(mode, arrays, all);
  } catch (const std::invalid_argument& error) {
    throw CallFailed(HL_INVALID_VALUE, error.what());
  }
  throwFailure();
}

// Of arrays of int16, uint16 or float32, as Python's side makes them.
HLenum sampleTypeOf(const py::array& samples) {
  const char kind = samples.dtype().kind();
  return kind == 'f' ? HL_FLOAT : kind == 'i' ? HL_SHORT : HL_UNSIGNED_SHORT;
}

// Of numbers along an axis of an array.
HLsizei sideOf(const py::array& samples, py::ssize_t axis) {
  return sizeOf(static_cast<std::size_t>(samples.shape(axis)), "samples");
}

// In C order, as Python's side makes it.
void heightField(const py::array& samples, std::optional<double> missing) {
  requireContext();
  hlHeightField(sideOf(samples, 1), sideOf(samples, 0), sampleTypeOf(samples), samples.data(),
                missing ? &*missing : nullptr);
  throwFailure();
}

void volume(const py::array& samples, double iso, std::optional<double> missing) {
  requireContext();
  hlVolume(sideOf(samples, 2), sideOf(samples, 1), sideOf(samples, 0), sampleTypeOf(samples), samples.data(),
           missing ? &*missing : nullptr, iso);
  throwFailure();
}

using Depths = py::array_t<HLushort, py::array::c_style | py::array::forcecast>;

void depthFrame(const Depths& depths, const Doubles& camera, double scale, double join, double smoothing) {
  requireContext();
  if (depths.ndim() != 2) throw CallFailed(HL_INVALID_VALUE, "depths must have the shape (rows, columns)");
  if (camera.size() != 4) throw CallFailed(HL_INVALID_VALUE, "camera must be four numbers: fx, fy, cx, cy");
  hlDepthFrame(sideOf(depths, 1), sideOf(depths, 0), depths.data(), camera.data(), scale, join, smoothing);
  throwFailure();
}

void volumeMatter(const Doubles& rows) {
  requireContext();
  const std::size_t count = rowsOf(rows, 3, "rows");
  hlVolumeMatter(sizeOf(count, "rows"), rows.data());
  throwFailure();
}

void nurbsSurface(const Doubles& points, HLint order_u, HLint order_v, const Optional& knots_u, const Optional& knots_v,
                  double error) {
  requireContext();
  if (points.ndim() != 3 || (points.shape(2) != 3 && points.shape(2) != 4))
    throw CallFailed(HL_INVALID_VALUE,
                     "control points have the shape (along v, along u, 3 or 4), and these " + shapeText(points));
  const auto each = static_cast<HLint>(points.shape(2));
  const auto side = [](const Optional& knots, HLint order, py::ssize_t there) -> HLsizei {
    if (knots && knots->ndim() != 1) throw CallFailed(HL_INVALID_VALUE, "knots are a list of numbers");
    const py::ssize_t wanted = knots ? knots->size() - order : order;
    if (wanted != there)
      throw CallFailed(HL_INVALID_VALUE, "there must be " + std::to_string(wanted) +
                                             " control points along a side, not " + std::to_string(there));
    return knots ? static_cast<HLsizei>(knots->size()) : 0;
  };
  const HLsizei count_u = side(knots_u, order_u, points.shape(1)), count_v = side(knots_v, order_v, points.shape(0));
  hlNurbsSurface(count_u, knots_u ? knots_u->data() : nullptr, count_v, knots_v ? knots_v->data() : nullptr, each,
                 static_cast<HLint>(each * points.shape(1)), points.data(), order_u, order_v,
                 each == 4 ? HL_MAP2_VERTEX_4 : HL_MAP2_VERTEX_3, error);
  throwFailure();
}

void pointCloud(const Doubles& points, const Optional& normals, double reach) {
  requireContext();
  const std::size_t count = rowsOf(points, 3, "points");
  hlPointCloud(sizeOf(count, "points"), points.data(), rowsOrNone(normals, count, 3, "normals"), reach);
  throwFailure();
}

void pointColors(const Bytes& colors) {
  requireContext();
  hlPointColors(sizeOf(rowsOf(colors, 3, "colors"), "colors"), colors.data());
  throwFailure();
}

void implicit(const std::string& json) {
  requireContext();
  hlImplicit(json.c_str());
  throwFailure();
}

void updateVertices(HLuint object, const Doubles& vertices, HLint first, const Optional& normals) {
  requireContext();
  const std::size_t count = rowsOf(vertices, 3, "vertices");
  hlUpdateVertices(object, first, sizeOf(count, "vertices"), vertices.data(), rowsOrNone(normals, count, 3, "normals"));
  throwFailure();
}

void jointTable(const Doubles& positions, const Doubles& forces) {
  requireContext();
  if (positions.ndim() != 1 || forces.ndim() != 1 || positions.size() != forces.size())
    throw CallFailed(HL_INVALID_VALUE, "a table has as many forces as positions, and they have the shapes " +
                                           shapeText(forces) + " and " + shapeText(positions));
  hlJointTable(sizeOf(static_cast<std::size_t>(positions.size()), "rows"), positions.data(), forces.data());
  throwFailure();
}

std::vector<HLuint> numbersOf(void (*generate)(HLsizei, HLuint*), HLsizei n) {
  requireContext();
  std::vector<HLuint> numbers(n > 0 ? static_cast<std::size_t>(n) : 0);
  generate(n, numbers.data());
  throwFailure();
  return numbers;
}

void forget(void (*remove)(HLsizei, const HLuint*), const std::vector<HLuint>& numbers) {
  requireContext();
  remove(sizeOf(numbers.size(), "numbers"), numbers.data());
  throwFailure();
}

/// Texels of HL_UNSIGNED_BYTE when the array has them, else of HL_FLOAT; `use(width, height, type, texels)`.
template <typename Use>
void withTexels(const py::array& texels, const Use& use) {
  requireContext();
  if (texels.ndim() != 2)
    throw CallFailed(HL_INVALID_VALUE, "texels must have the shape (height, width), and has " + shapeText(texels));
  const HLsizei width = sizeOf(static_cast<std::size_t>(texels.shape(1)), "texels");
  const HLsizei height = sizeOf(static_cast<std::size_t>(texels.shape(0)), "texels");
  if (py::isinstance<py::array_t<HLubyte>>(texels)) {
    const Bytes bytes(texels);
    use(width, height, HL_UNSIGNED_BYTE, bytes.data());
  } else {
    const Floats floats(texels);
    use(width, height, HL_FLOAT, floats.data());
  }
  throwFailure();
}

void texImage(const py::array& texels) {
  withTexels(texels, [](HLsizei width, HLsizei height, HLenum type, const void* data) {
    hlTexImage2D(HL_TEXTURE_2D, 0, HL_LUMINANCE, width, height, 0, HL_LUMINANCE, type, data);
  });
}

void texSubImage(HLint x, HLint y, const py::array& texels) {
  withTexels(texels, [x, y](HLsizei width, HLsizei height, HLenum type, const void* data) {
    hlTexSubImage2D(HL_TEXTURE_2D, 0, x, y, width, height, HL_LUMINANCE, type, data);
  });
}

/// Of one name, no query has more.
template <typename Number>
using Values = std::array<Number, 16>;

/// A number, or a list where the query has several.
template <typename Number>
py::object numberOrList(const Values<Number>& values, HLenum name) {
  const std::size_t count = valuesOf(name);
  if (count == 1) return py::cast(values[0]);
  return py::cast(std::vector<Number>(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(count)));
}

template <typename Number>
py::object query(void (*call)(HLenum, Number*), HLenum name) {
  requireContext();
  Values<Number> values{};
  call(name, values.data());
  throwFailure();
  return numberOrList(values, name);
}

/// The same of a body or joint; None: the last state has no such one.
py::object queryOf(HLboolean (*call)(HLuint, HLenum, HLdouble*), HLuint number, HLenum name) {
  requireContext();
  Values<HLdouble> values{};
  const bool written = call(number, name, values.data()) != HL_FALSE;
  throwFailure();
  return written ? numberOrList(values, name) : py::none();
}

std::string stringOf(HLenum name) {
  requireContext();
  const char* const text = hlGetString(name);
  throwFailure();
  return text != nullptr ? text : "";
}

std::string stringOfDevice(HLenum name, HLuint device) {
  requireContext();
  const char* const text = hlGetStringi(name, device);
  throwFailure();
  return text != nullptr ? text : "";
}

template <typename Row>
py::array_t<Row> structuredArray(const std::vector<Row>& rows) {
  return py::array_t<Row>(static_cast<py::ssize_t>(rows.size()), rows.data());
}

void bindJoints(py::module_& module) {
  PYBIND11_NUMPY_DTYPE(HLjoint, joint, coordinate, velocity, force, hold);
  module.def("hlJointTable", &jointTable, py::arg("positions"), py::arg("forces"));
  module.def("hlGetJoints", [] {
    requireContext();
    return structuredArray(hl::joints());
  });
  module.def(
      "hlGetJointdv", [](HLuint joint, HLenum name) { return queryOf(&hlGetJointdv, joint, name); }, py::arg("joint"),
      py::arg("name"));
}

// Texts of a fixed size, as numpy has them.
void bindRemoteHands(py::module_& module) {
  PYBIND11_NUMPY_DTYPE(HLremotehand, server, device, finger, proxy, force, rotation, radius, buttons, contacts);
  module.def("hlGetRemoteHands", [] {
    requireContext();
    return structuredArray(hl::remoteHands());
  });
}

void bindContactReports(py::module_& module) {
  PYBIND11_NUMPY_DTYPE(HLcontactforce, object, name, session, vertex_count, vertices, weights, point, force);
  PYBIND11_NUMPY_DTYPE(HLcontactreport, time, interval, force);
  module.def("hlTakeContactReport", [] {
    requireContext();
    const hl::ContactReport report = hl::takeContactReport();
    return std::pair(structuredArray(report.contacts), structuredArray(std::vector<HLcontactreport>{report.mean}));
  });
  module.def(
      "hlCompliance",
      [](HLuint object, HLdouble normal, HLdouble tangential, std::optional<std::array<HLdouble, 3>> force) {
        requireContext();
        hlCompliance(object, normal, tangential, force ? force->data() : nullptr);
        throwFailure();
      },
      py::arg("object"), py::arg("normal"), py::arg("tangential"), py::arg("force") = py::none());
}

void bindDrawing(py::module_& module) {
  const auto none = py::none();
  module.def("hlDrawArrays", &drawArrays, py::arg("mode"), py::arg("vertices"), py::arg("normals") = none,
             py::arg("texcoords") = none);
  module.def("hlDrawElements", &drawElements, py::arg("mode"), py::arg("vertices"), py::arg("indices"),
             py::arg("normals") = none, py::arg("texcoords") = none);
  module.def("hlHeightField", &heightField, py::arg("samples"), py::arg("missing") = none);
  module.def("hlDepthFrame", &depthFrame, py::arg("depths"), py::arg("camera"), py::arg("scale"), py::arg("join"),
             py::arg("smoothing"));
  module.def("hlImplicit", &implicit, py::arg("json"));
  module.def("hlVolumeMatter", &volumeMatter, py::arg("rows"));
  module.def("hlPointCloud", &pointCloud, py::arg("points"), py::arg("normals") = none, py::arg("reach") = 0.0);
  module.def("hlPointColors", &pointColors, py::arg("colors"));
  module.def("hlVolume", &volume, py::arg("samples"), py::arg("iso"), py::arg("missing") = none);
  module.def("hlNurbsSurface", &nurbsSurface, py::arg("points"), py::arg("order_u") = 4, py::arg("order_v") = 4,
             py::arg("knots_u") = none, py::arg("knots_v") = none, py::arg("error") = 0.0);
}

}  // namespace

void bindArrayCalls(py::module_& module) {
  PYBIND11_NUMPY_DTYPE(HLcontact, point, normal, share, static_friction, stiffness, object, name, session);
  PYBIND11_NUMPY_DTYPE(HLbody, object, name, position, rotation, velocity, spin);
  PYBIND11_NUMPY_DTYPE(HLsample, time, position, force, buttons, rotation, spin, gripper, grip_force);
  bindDrawing(module);
  const auto none = py::none();
  module.def("hlUpdateVertices", &updateVertices, py::arg("object"), py::arg("vertices"), py::arg("first") = 0,
             py::arg("normals") = none);
  module.def(
      "hlGenObjects", [](HLsizei n) { return numbersOf(&hlGenObjects, n); }, py::arg("n"));
  module.def(
      "hlGenTextures", [](HLsizei n) { return numbersOf(&hlGenTextures, n); }, py::arg("n"));
  module.def(
      "hlDeleteObjects", [](const std::vector<HLuint>& objects) { forget(&hlDeleteObjects, objects); },
      py::arg("objects"));
  module.def(
      "hlDeleteTextures", [](const std::vector<HLuint>& textures) { forget(&hlDeleteTextures, textures); },
      py::arg("textures"));
  module.def("hlTexImage2D", &texImage, py::arg("texels"));
  module.def("hlTexSubImage2D", &texSubImage, py::arg("x"), py::arg("y"), py::arg("texels"));
  module.def(
      "hlGetDoublev", [](HLenum name) { return query(&hlGetDoublev, name); }, py::arg("name"));
  module.def(
      "hlGetFloatv", [](HLenum name) { return query(&hlGetFloatv, name); }, py::arg("name"));
  module.def(
      "hlGetIntegerv", [](HLenum name) { return query(&hlGetIntegerv, name); }, py::arg("name"));
  module.def(
      "hlGetBooleanv", [](HLenum name) { return query(&hlGetBooleanv, name); }, py::arg("name"));
  module.def("hlGetString", &stringOf, py::arg("name"));
  module.def("hlGetStringi", &stringOfDevice, py::arg("name"), py::arg("device"));
  module.def("hlGetContacts", [] {
    requireContext();
    return structuredArray(hl::contacts());
  });
  module.def("hlGetBodies", [] {
    requireContext();
    return structuredArray(hl::bodies());
  });
  module.def(
      "hlGetBodydv", [](HLuint object, HLenum name) { return queryOf(&hlGetBodydv, object, name); }, py::arg("object"),
      py::arg("name"));
  module.def("hlTakeSamples", [] {
    requireContext();
    return structuredArray(hl::takeSamples());
  });
  bindJoints(module);
  bindRemoteHands(module);
  bindContactReports(module);
}
