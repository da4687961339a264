// The calls of hl_batch.h. Other Python threads run while they compute, and Ctrl-C is heard.
#include <hl/hl_batch.h>
#include <pybind11/stl.h>

#include <memory>
#include <mutex>
#include <vector>

#include "arrays.h"
#include "batch/ends_early.h"
#include "bindings.h"
#include "other_threads_run.h"
#include "signals.h"

namespace py = pybind11;

namespace {

void checkBatch(HLenum code) {
  if (code != HL_NO_ERROR) throw CallFailed(code, hlBatchError());
}

/// What a call that makes something returned; NULL is an error. It is of this thread, so the text is still there.
template <typename T>
T* made(T* pointer) {
  if (pointer == nullptr) throw CallFailed(HL_INVALID_VALUE, hlBatchError());
  return pointer;
}

/// Makes a call of hl_batch.h without the interpreter's lock; Ctrl-C ends it. `rows`: what it computes.
template <typename Call>
void checkBatchHearingSignals(std::size_t rows, const Call& call) {
  constexpr std::size_t kFewRows = 256;  // some ms, for which a thread is not worth its 30 us
  if (rows <= kFewRows || !isMainThread()) {
    const OtherThreadsRun other_threads_run;
    return checkBatch(call());
  }
  std::atomic<bool> stop = false;
  runHearingSignals(stop, [&] {
    const hl::EndsEarly ends_early(stop);
    checkBatch(call());
  });
}

struct DeleteBatch {
  void operator()(HLbatchScene* scene) const { hlBatchDeleteScene(scene); }
  void operator()(HLbatchFingers* fingers) const { hlBatchDeleteFingers(fingers); }
};

struct Scene {
  explicit Scene(HLbatchScene* scene) : handle(scene) {}

  const std::unique_ptr<HLbatchScene, DeleteBatch> handle;
};

struct Fingers {
  Fingers(HLbatchFingers* fingers, std::size_t fingers_in_it) : handle(fingers), count(fingers_in_it) {}

  const std::unique_ptr<HLbatchFingers, DeleteBatch> handle;
  const std::size_t count;
  std::mutex one_at_a_time;  ///< taken without the interpreter's lock
};

std::unique_ptr<Scene> loadScene(const std::string& name, double size) {
  const OtherThreadsRun other_threads_run;
  return std::make_unique<Scene>(made(hlBatchLoadScene(name.c_str(), size)));
}

std::unique_ptr<Scene> makeImplicit(const std::string& json) {
  const OtherThreadsRun other_threads_run;
  return std::make_unique<Scene>(made(hlBatchMakeImplicit(json.c_str())));
}

std::unique_ptr<Scene> makeScene(const Doubles& vertices, const Indices& triangles,
                                 const std::optional<Doubles>& normals) {
  const std::size_t count = rowsOf(vertices, 3, "vertices");
  const std::size_t faces = rowsOf(triangles, 3, "triangles");
  const double* const smooth = rowsOrNone(normals, count, 3, "normals");
  const OtherThreadsRun other_threads_run;
  return std::make_unique<Scene>(made(hlBatchMakeScene(vertices.data(), smooth, count, triangles.data(), faces)));
}

// Of arrays of int16, uint16 or float32 in C order, as Python's side makes them.
HLenum sampleTypeOf(const py::array& samples) {
  const char kind = samples.dtype().kind();
  return kind == 'f' ? HL_FLOAT : kind == 'i' ? HL_SHORT : HL_UNSIGNED_SHORT;
}

std::unique_ptr<Scene> makeVolume(const py::array& samples, const std::array<double, 3>& spacing,
                                  const std::vector<double>& iso, std::optional<double> missing, bool below) {
  std::array<std::size_t, 3> size{};
  for (py::ssize_t axis = 0; axis < 3; ++axis)
    size[static_cast<std::size_t>(2 - axis)] = static_cast<std::size_t>(samples.shape(axis));
  const HLenum type = sampleTypeOf(samples);
  const void* const data = samples.data();
  const OtherThreadsRun other_threads_run;
  const auto make = below ? hlBatchMakeDistances : hlBatchMakeVolume;
  return std::make_unique<Scene>(
      made(make(size.data(), type, data, missing ? &*missing : nullptr, spacing.data(), iso.size(), iso.data())));
}

std::unique_ptr<Scene> makeHeights(const py::array& samples, const std::array<double, 2>& spacing, double scale,
                                   std::optional<double> missing) {
  const std::size_t columns = static_cast<std::size_t>(samples.shape(1)),
                    rows = static_cast<std::size_t>(samples.shape(0));
  const HLenum type = sampleTypeOf(samples);
  const void* const data = samples.data();
  const OtherThreadsRun other_threads_run;
  return std::make_unique<Scene>(
      made(hlBatchMakeHeights(columns, rows, type, data, missing ? &*missing : nullptr, spacing.data(), scale)));
}

std::unique_ptr<Scene> makePoints(const Doubles& points, const std::optional<Doubles>& normals, double reach) {
  const std::size_t count = rowsOf(points, 3, "points");
  const double* const smooth = rowsOrNone(normals, count, 3, "normals");
  const OtherThreadsRun other_threads_run;
  return std::make_unique<Scene>(made(hlBatchMakePoints(points.data(), smooth, count, reach)));
}

Doubles boundsOf(const Scene& scene) {
  Doubles bounds = emptyRows(2, 3);
  hlBatchSceneBounds(scene.handle.get(), bounds.mutable_data(0), bounds.mutable_data(1));
  return bounds;
}

std::vector<std::string> warningsOf(const Scene& scene) {
  std::vector<std::string> warnings;
  while (const char* const warning = hlBatchSceneWarning(scene.handle.get(), warnings.size()))
    warnings.emplace_back(warning);
  return warnings;
}

HLbatchSettings makeSettings(double radius, double spring, double period, std::optional<bool> smooth) {
  HLbatchSettings settings;
  hlBatchSettings(&settings);
  settings.radius = radius;
  settings.spring = spring;
  settings.period = period;
  if (smooth) settings.smooth = *smooth ? HL_TRUE : HL_FALSE;
  return settings;
}

/// The arrays that a result is written to.
class Rows {
 public:
  explicit Rows(std::size_t rows)
      : proxy_(emptyRows(rows, 3)),
        force_(emptyRows(rows, 3)),
        contacts_(static_cast<py::ssize_t>(rows)),
        injected_(static_cast<py::ssize_t>(rows)) {}

  HLbatchResult pointers() {
    return {proxy_.mutable_data(), force_.mutable_data(), contacts_.mutable_data(), injected_.mutable_data()};
  }
  py::tuple tuple() const { return py::make_tuple(proxy_, force_, contacts_, injected_); }

 private:
  Doubles proxy_, force_;
  py::array_t<HLint> contacts_;
  Doubles injected_;
};

py::tuple trace(const Scene& scene, const HLbatchSettings& settings, const Doubles& samples,
                const std::vector<std::size_t>& ends, int threads) {
  const std::size_t count = rowsOf(samples, 4, "paths");
  if ((ends.empty() ? 0 : ends.back()) != count)
    throw CallFailed(HL_INVALID_VALUE, "the last path must end the samples");
  Rows rows(count);
  const HLbatchResult result = rows.pointers();
  checkBatchHearingSignals(count, [&] {
    return hlBatchTrace(scene.handle.get(), &settings, ends.size(), ends.data(), samples.data(), threads, &result);
  });
  return rows.tuple();
}

std::unique_ptr<Fingers> makeFingers(const Scene& scene, const HLbatchSettings& settings, std::size_t count) {
  return std::make_unique<Fingers>(made(hlBatchMakeFingers(scene.handle.get(), &settings, count)), count);
}

py::tuple step(Fingers& fingers, const Doubles& positions, int threads) {
  if (rowsOf(positions, 3, "positions") != fingers.count)
    throw CallFailed(HL_INVALID_VALUE, "positions must have one row for each finger: (" +
                                           std::to_string(fingers.count) + ", 3), and has " + shapeText(positions));
  Rows rows(fingers.count);
  const HLbatchResult result = rows.pointers();
  {
    const OtherThreadsRun other_threads_run;
    const std::scoped_lock lock(fingers.one_at_a_time);
    checkBatch(hlBatchStep(fingers.handle.get(), positions.data(), threads, &result));
  }
  return rows.tuple();
}

void reset(Fingers& fingers, const std::optional<py::array_t<bool, py::array::c_style | py::array::forcecast>>& mask) {
  if (mask && (mask->ndim() != 1 || static_cast<std::size_t>(mask->shape(0)) != fingers.count))
    throw CallFailed(HL_INVALID_VALUE, "mask must have one element for each finger, and has " + shapeText(*mask));
  const auto* const chosen = mask ? reinterpret_cast<const unsigned char*>(mask->data()) : nullptr;
  const OtherThreadsRun other_threads_run;
  const std::scoped_lock lock(fingers.one_at_a_time);
  hlBatchResetFingers(fingers.handle.get(), chosen);
}

py::tuple closest(const Scene& scene, const Doubles& points, int threads) {
  const std::size_t count = rowsOf(points, 3, "points");
  Doubles nearest = emptyRows(count, 3), normal = emptyRows(count, 3), distance(static_cast<py::ssize_t>(count));
  py::array_t<std::uint64_t> primitive(static_cast<py::ssize_t>(count));
  double *const to = nearest.mutable_data(), *const unit = normal.mutable_data(), *const far = distance.mutable_data();
  std::uint64_t* const number = primitive.mutable_data();
  checkBatchHearingSignals(
      count, [&] { return hlBatchClosest(scene.handle.get(), count, points.data(), threads, to, far, unit, number); });
  return py::make_tuple(nearest, distance, normal, primitive);
}

}  // namespace

void bindBatch(py::module_& module) {
  py::class_<Scene>(module, "BatchScene")
      .def(py::init(&loadScene), py::arg("name"), py::arg("size"))
      .def(py::init(&makeScene), py::arg("vertices"), py::arg("triangles"), py::arg("normals"))
      .def(py::init(&makeVolume), py::arg("volume"), py::arg("spacing"), py::arg("iso"), py::arg("missing"),
           py::arg("below"))
      .def(py::init(&makeImplicit), py::arg("implicit"))
      .def(py::init(&makeHeights), py::arg("samples"), py::arg("spacing"), py::arg("scale"), py::arg("missing"))
      .def(py::init(&makePoints), py::arg("points"), py::arg("normals"), py::arg("reach"))
      .def_property_readonly("primitives",
                             [](const Scene& scene) { return hlBatchScenePrimitives(scene.handle.get()); })
      .def_property_readonly("bounds", &boundsOf)
      .def_property_readonly("warnings", &warningsOf);
  py::class_<HLbatchSettings>(module, "BatchSettings")
      .def(py::init(&makeSettings), py::arg("radius"), py::arg("spring"), py::arg("period"), py::arg("smooth"))
      .def("set_surface", [](HLbatchSettings& settings, HLenum quantity, double value) {
        checkBatch(hlBatchSurface(&settings, quantity, value));
      });
  py::class_<Fingers>(module, "BatchFingers")
      .def(py::init(&makeFingers), py::arg("scene"), py::arg("settings"), py::arg("count"))
      .def("step", &step, py::arg("positions"), py::arg("threads"))
      .def("reset", &reset, py::arg("mask"));
  module.def("trace", &trace, py::arg("scene"), py::arg("settings"), py::arg("samples"), py::arg("ends"),
             py::arg("threads"));
  module.def("closest", &closest, py::arg("scene"), py::arg("points"), py::arg("threads"));
}
