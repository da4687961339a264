// The calls of hl_batch.h: arrays are checked and read here, and everything else is batch.h's.
#include <hl/hl_batch.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstring>
#include <memory>
#include <new>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/finger_reach.h"
#include "base/quantities.h"
#include "batch/batch.h"
#include "batch/ends_early.h"
#include "batch/on_threads.h"
#include "io/decode_implicit.h"
#include "io/decode_volumes.h"
#include "io/load_scene.h"
#include "io/read_heights.h"
#include "scene/scene_model.h"
#include "scene/tight_bounds.h"
#include "surfaces/cloud_maker.h"
#include "surfaces/grid_frame.h"
#include "surfaces/height_field.h"
#include "surfaces/point_cloud.h"
#include "surfaces/sample_room.h"
#include "wire/implicit_json.h"

struct HLbatchScene {
  std::shared_ptr<const hl::Snapshot> snapshot;
};

struct HLbatchFingers {
  hl::FingerBatch batch;
};

namespace {

using namespace hl;

thread_local std::string last_error;

constexpr std::array<HLenum, kNumbers> kQuantityOf{
#define HL_QUANTITY(quantity, field, NAME, ...) HL_##NAME,
#include "base/quantities.def"
#undef HL_QUANTITY
};
static_assert(kNumbers <= std::size(HLbatchSettings{}.surface));

// Runs `work`; what it throws becomes an error code and a line.
template <typename Work>
HLenum guardedCall(const char* call, const Work& work) {
  try {
    work();
    return HL_NO_ERROR;
  } catch (const std::bad_alloc&) {
    last_error = std::string(call) + ": there is not enough memory";
    return HL_OUT_OF_MEMORY;
  } catch (const std::length_error&) {  // of a vector
    last_error = std::string(call) + ": there is not enough memory";
    return HL_OUT_OF_MEMORY;
  } catch (const std::exception& error) {
    last_error = std::string(call) + ": " + error.what();
    return HL_INVALID_VALUE;
  }
}

void require(bool holds, const char* what) {
  if (!holds) throw Error(what);
}

SampleKind kindOf(HLenum type) {
  require(type == HL_SHORT || type == HL_UNSIGNED_SHORT || type == HL_FLOAT,
          "samples are HL_SHORT, HL_UNSIGNED_SHORT or HL_FLOAT");
  if (type == HL_FLOAT) return SampleKind::kFloat32;
  return type == HL_SHORT ? SampleKind::kInt16 : SampleKind::kUint16;
}

std::shared_ptr<const void> copyOf(const void* samples, std::size_t bytes) {
  SampleRoom kept(bytes);
  kept.add(samples, bytes);
  return kept.take();
}

// The sample that stands for none.
std::optional<double> missingOf(const HLdouble* missing) {
  require(missing == nullptr || std::isfinite(*missing), "missing must be finite");
  return missing != nullptr ? std::optional<double>(*missing) : std::nullopt;
}

std::string outOfRange(const QuantityInfo& quantity) {
  std::ostringstream text;
  text << "HL_" << quantity.name << " is out of its range, 0 to " << quantity.most_set;
  return text.str();
}

// As hl trace: no product of them, lengths and speeds leaves the range of doubles.
constexpr double kMinRadius_m = 1e-12, kMaxRadius_m = 1e9, kMinSpring_N_m = 1e-9, kMaxSpring_N_m = 1e9;

// Beyond it a count cannot be that of an array: indices have 32 bits.
void requireCount(std::size_t count, const char* what) { require(count <= std::numeric_limits<HLuint>::max(), what); }

void requireFinite(const HLdouble* numbers, std::size_t count, const char* what) {
  require(std::all_of(numbers, numbers + count, [](double x) { return std::isfinite(x); }), what);
}

// Where a finger, or a point that is asked for, may be.
void requireReach(const HLdouble* numbers, std::size_t count, const char* what) {
  require(std::all_of(numbers, numbers + count, [](double x) { return std::abs(x) <= kFarthestFinger_m; }), what);
}

// A negative one would mirror what it is given.
void requireSpacing(const HLdouble* spacing, std::size_t axes) {
  const auto sound = [](double step) { return step >= kMinGridStep && step <= kMaxGridStep; };
  require(std::all_of(spacing, spacing + axes, sound), "spacing must be from 1e-12 to 1e9 m along each axis");
}

// Without a budget of work: nothing waits for a step, and so the machine decides nothing.
ProxySettings settingsOf(const HLbatchSettings* given) {
  require(given != nullptr, "settings is NULL; hlBatchSettings makes some");
  require(given->radius >= kMinRadius_m && given->radius <= kMaxRadius_m, "the radius must be 1e-12 to 1e9 m");
  require(given->spring >= kMinSpring_N_m && given->spring <= kMaxSpring_N_m, "the spring must be 1e-9 to 1e9 N/m");
  require(given->period >= kMinStep_s && given->period <= kLastTime_s, "the period must be 1e-15 to 1e15 s");
  require(given->smooth >= -1 && given->smooth <= 1, "smooth must be HL_TRUE, HL_FALSE or -1");
  ProxySettings settings;
  settings.radius = given->radius;
  settings.spring_N_m = given->spring;
  settings.period_s = given->period;
  settings.work_cap = kNoWorkCap;
  if (given->smooth >= 0) settings.surfaces.smooth = given->smooth != 0;
  for (std::size_t i = 0; i < kNumbers; ++i) {
    if (given->surface[i] >= 0) settings.surfaces.number(i) = given->surface[i];
  }
  return settings;
}

void requireThreads(HLint threads) { require(threads >= 0, "threads must not be negative"); }

Vec3 vecAt(const HLdouble* numbers, std::size_t i) {
  return Vec3(numbers[3 * i], numbers[3 * i + 1], numbers[3 * i + 2]);
}

void put(HLdouble* numbers, std::size_t i, const Vec3& v) {
  if (numbers != nullptr) std::copy_n(v.data(), 3, numbers + 3 * i);
}

void put(const HLbatchResult& result, std::size_t i, const BatchRow& row) {
  put(result.proxy, i, row.proxy);
  put(result.force, i, row.force_N);
  if (result.contacts != nullptr) result.contacts[i] = row.contacts;
  if (result.injected != nullptr) result.injected[i] = row.injected_J;
}

HLbatchScene* sceneOf(SceneModel model) {
  auto snapshot = makeSnapshot(std::move(model));
  if (snapshot->primitives == 0)
    throw Error("nothing in it can be touched" + (snapshot->warnings.empty() ? "" : ": " + snapshot->warnings.back()));
  return new HLbatchScene{std::move(snapshot)};
}

// What hlBatchMakeVolume and hlBatchMakeDistances are given.
struct GivenVolume {
  const std::size_t* size;
  HLenum type;
  const void* samples;
  const HLdouble* missing;
  const HLdouble* spacing;
  std::size_t surfaces;
  const HLdouble* iso;
};

SceneModel modelOf(const GivenVolume& in, SolidSide solid) {
  require(in.size != nullptr && in.samples != nullptr && in.spacing != nullptr, "size, samples or spacing is NULL");
  requireSpacing(in.spacing, 3);
  require(in.surfaces > 0 && in.iso != nullptr, "a volume needs an iso value");
  require(*std::max_element(in.size, in.size + 3) <= kMaxVoxelSide, "there are too many samples along an axis");
  std::array<std::uint32_t, 3> side{};
  std::transform(in.size, in.size + 3, side.begin(), [](std::size_t n) { return static_cast<std::uint32_t>(n); });
  checkVoxelSides(side);
  const SampleKind kind = kindOf(in.type);
  const std::size_t bytes = in.size[0] * in.size[1] * in.size[2] * sizeOf(kind);
  const Samples kept(kind, copyOf(in.samples, bytes), missingOf(in.missing));
  const PlacedVolume volume{std::make_shared<const Volume>(VoxelGrid(side, kept)),
                            uprightFrame(side, vecAt(in.spacing, 0))};
  SceneModel made;
  for (std::size_t i = 0; i < in.surfaces; ++i)
    made.surfaces.push_back({"volume", isoSurfaceOf(volume, {in.iso[i], solid})});
  return made;
}

// It takes seconds for the longest paths, in which `stop` is heard.
std::vector<PathSample> samplesOf(const HLdouble* numbers, std::size_t paths, const std::size_t* ends,
                                  const std::atomic<bool>* stop) {
  require(std::is_sorted(ends, ends + paths), "ends must not fall");
  std::vector<PathSample> samples;
  samples.reserve(paths == 0 ? 0 : ends[paths - 1]);
  std::size_t begin = 0;
  for (std::size_t path = 0; path < paths; begin = ends[path++]) {
    for (std::size_t i = begin; i < ends[path]; ++i) {
      throwIfStopped(stop);
      const HLdouble* const row = numbers + 4 * i;
      requireReach(row, 4, "samples must be finite, and within 1e15 m and s of 0");
      require(i == begin || row[0] - samples.back().t >= kMinStep_s,
              "the times of a path must rise, by 1e-15 s at least");
      samples.push_back({row[0], Vec3(row[1], row[2], row[3])});
    }
  }
  return samples;
}

}  // namespace

const char* hlBatchError(void) { return last_error.c_str(); }

HLbatchScene* hlBatchLoadScene(const char* name, HLdouble size) {
  HLbatchScene* scene = nullptr;
  guardedCall(__func__, [&] {
    require(name != nullptr, "name is NULL");
    require(std::isfinite(size) && size >= 0, "size must be finite and not negative");
    SceneModel loaded = loadScene(name);
    if (size > 0) fitModel(loaded, size);
    scene = sceneOf(std::move(loaded));
  });
  return scene;
}

HLbatchScene* hlBatchMakeScene(const HLdouble* positions, const HLdouble* normals, size_t vertices,
                               const HLuint* indices, size_t triangles) {
  HLbatchScene* scene = nullptr;
  guardedCall(__func__, [&] {
    require(positions != nullptr && indices != nullptr, "positions or indices is NULL");
    requireCount(vertices, "there are more vertices than indices can name");
    requireCount(triangles, "there are too many triangles");
    requireFinite(positions, 3 * vertices, "vertices must be finite");
    if (normals != nullptr) requireFinite(normals, 3 * vertices, "normals must be finite");
    require(std::all_of(indices, indices + 3 * triangles, [&](HLuint i) { return i < vertices; }),
            "an index names no vertex");
    Model model;
    for (std::size_t i = 0; i < vertices; ++i) model.positions.push_back(vecAt(positions, i));
    for (std::size_t i = 0; normals != nullptr && i < vertices; ++i) model.normals.push_back(vecAt(normals, i));
    for (std::size_t i = 0; i < triangles; ++i)
      model.triangles.push_back({indices[3 * i], indices[3 * i + 1], indices[3 * i + 2]});
    model.materials[0].smooth = normals != nullptr;
    scene = sceneOf(std::move(model));
  });
  return scene;
}

HLbatchScene* hlBatchMakeHeights(size_t columns, size_t rows, HLenum type, const void* samples, const HLdouble* missing,
                                 const HLdouble* spacing, HLdouble scale) {
  HLbatchScene* scene = nullptr;
  guardedCall(__func__, [&] {
    require(samples != nullptr && spacing != nullptr, "samples or spacing is NULL");
    requireSpacing(spacing, 2);
    require(columns <= kMaxGridSide && rows <= kMaxGridSide, "there are too many columns or rows");
    const GridSize size{static_cast<std::uint32_t>(columns), static_cast<std::uint32_t>(rows), kindOf(type)};
    const auto grid = std::make_shared<const HeightGrid>(size, copyOf(samples, size.bytes()), missingOf(missing));
    const auto field = std::make_shared<const HeightField>(grid, uprightFrame(size, spacing[0], spacing[1], scale));
    requireTriangles(*field);
    requireSlopes(*field);
    SceneModel made;
    made.surfaces.push_back({"heights", field});
    scene = sceneOf(std::move(made));
  });
  return scene;
}

HLbatchScene* hlBatchMakeVolume(const size_t* size, HLenum type, const void* samples, const HLdouble* missing,
                                const HLdouble* spacing, size_t surfaces, const HLdouble* iso) {
  HLbatchScene* scene = nullptr;
  guardedCall(__func__, [&] {
    scene = sceneOf(modelOf({size, type, samples, missing, spacing, surfaces, iso}, SolidSide::kAbove));
  });
  return scene;
}

HLbatchScene* hlBatchMakeDistances(const size_t* size, HLenum type, const void* samples, const HLdouble* missing,
                                   const HLdouble* spacing, size_t surfaces, const HLdouble* iso) {
  HLbatchScene* scene = nullptr;
  guardedCall(__func__, [&] {
    scene = sceneOf(modelOf({size, type, samples, missing, spacing, surfaces, iso}, SolidSide::kBelow));
  });
  return scene;
}

HLbatchScene* hlBatchMakePoints(const HLdouble* points, const HLdouble* normals, size_t count, HLdouble reach) {
  HLbatchScene* scene = nullptr;
  guardedCall(__func__, [&] {
    require(points != nullptr, "points is NULL");
    requireCount(count, "there are too many points");
    requireFinite(points, 3 * count, "points must be finite");
    if (normals != nullptr) requireFinite(normals, 3 * count, "normals must be finite");
    std::vector<Vec3> positions;
    std::vector<std::uint32_t> packed;
    for (std::size_t i = 0; i < count; ++i) positions.push_back(vecAt(points, i));
    for (std::size_t i = 0; normals != nullptr && i < count; ++i) packed.push_back(packNormal(vecAt(normals, i)));
    std::size_t skipped = 0;
    CloudLook look;
    if (reach != 0) look = {CloudForm::kSurfels, reach};
    SceneModel made;
    made.surfaces.push_back(
        {"points", std::make_shared<const PointCloud>(makeCloud(onFineLattice(positions, packed, skipped)), look)});
    made.surfaces.back().material.smooth = normals != nullptr;
    scene = sceneOf(std::move(made));
  });
  return scene;
}

HLbatchScene* hlBatchMakeImplicit(const char* json) {
  HLbatchScene* scene = nullptr;
  guardedCall(__func__, [&] {
    require(json != nullptr, "json is NULL");
    SceneModel made;
    made.surfaces.push_back({"implicit", decodeImplicit(implicitOfJson(json))});
    scene = sceneOf(std::move(made));
  });
  return scene;
}

void hlBatchDeleteScene(HLbatchScene* scene) { delete scene; }

size_t hlBatchScenePrimitives(const HLbatchScene* scene) { return scene != nullptr ? scene->snapshot->primitives : 0; }

const char* hlBatchSceneWarning(const HLbatchScene* scene, size_t number) {
  if (scene == nullptr || number >= scene->snapshot->warnings.size()) return nullptr;
  return scene->snapshot->warnings[number].c_str();
}

void hlBatchSceneBounds(const HLbatchScene* scene, HLdouble* low, HLdouble* high) {
  if (scene == nullptr) return;
  const Box bounds = tightBounds(*scene->snapshot);
  put(low, 0, bounds.min);
  put(high, 0, bounds.max);
}

void hlBatchSettings(HLbatchSettings* settings) {
  if (settings == nullptr) return;
  const ProxySettings usual;
  *settings = {0.002, usual.spring_N_m, usual.period_s, -1, {}};
  std::fill(std::begin(settings->surface), std::end(settings->surface), -1.0);
}

HLenum hlBatchSurface(HLbatchSettings* settings, HLenum quantity, HLdouble value) {
  return guardedCall(__func__, [&] {
    require(settings != nullptr, "settings is NULL");
    const auto found = std::find(kQuantityOf.begin(), kQuantityOf.end(), quantity);
    require(found != kQuantityOf.end(), "there is no such quantity");
    const auto i = static_cast<std::size_t>(found - kQuantityOf.begin());
    if (!(value >= 0 && value <= kQuantityInfo[i].most_set)) throw Error(outOfRange(kQuantityInfo[i]));
    settings->surface[i] = value;
  });
}

HLenum hlBatchTrace(const HLbatchScene* scene, const HLbatchSettings* settings, size_t paths, const size_t* ends,
                    const HLdouble* samples, HLint threads, const HLbatchResult* result) {
  return guardedCall(__func__, [&] {
    require(scene != nullptr && result != nullptr, "scene or result is NULL");
    require(paths == 0 || (ends != nullptr && samples != nullptr), "ends or samples is NULL");
    requireThreads(threads);
    const ProxySettings rules = settingsOf(settings);
    const std::atomic<bool>* const stop = EndsEarly::ofThisThread();
    const std::vector<PathSample> read = samplesOf(samples, paths, ends, stop);
    traceBatch(*scene->snapshot, rules, read, {ends, paths}, threads, [&](std::size_t i, const BatchRow& row) {
      throwIfStopped(stop);
      put(*result, i, row);
    });
  });
}

HLbatchFingers* hlBatchMakeFingers(const HLbatchScene* scene, const HLbatchSettings* settings, size_t fingers) {
  HLbatchFingers* made = nullptr;
  guardedCall(__func__, [&] {
    require(scene != nullptr, "scene is NULL");
    require(movingBodies(*scene->snapshot) == 0,
            "bodies move by each finger alone: of a scene with bodies take traces, or give the bodies fixed");
    made = new HLbatchFingers{FingerBatch(scene->snapshot, settingsOf(settings), fingers)};
  });
  return made;
}

void hlBatchDeleteFingers(HLbatchFingers* fingers) { delete fingers; }

HLenum hlBatchStep(HLbatchFingers* fingers, const HLdouble* positions, HLint threads, const HLbatchResult* result) {
  return guardedCall(__func__, [&] {
    require(fingers != nullptr && positions != nullptr && result != nullptr, "fingers, positions or result is NULL");
    requireThreads(threads);
    requireReach(positions, 3 * fingers->batch.size(), "positions must be finite, and within 1e15 m of the origin");
    std::vector<Vec3> places;
    places.reserve(fingers->batch.size());
    for (std::size_t i = 0; i < fingers->batch.size(); ++i) places.push_back(vecAt(positions, i));
    fingers->batch.step(places, threads, [&](std::size_t i, const BatchRow& row) { put(*result, i, row); });
  });
}

void hlBatchResetFingers(HLbatchFingers* fingers, const unsigned char* mask) {
  if (fingers == nullptr) return;
  for (std::size_t i = 0; i < fingers->batch.size(); ++i) {
    if (mask == nullptr || mask[i] != 0) fingers->batch.reset(i);
  }
}

HLenum hlBatchClosest(const HLbatchScene* scene, size_t count, const HLdouble* points, HLint threads, HLdouble* nearest,
                      HLdouble* distance, HLdouble* normal, uint64_t* primitive) {
  return guardedCall(__func__, [&] {
    require(scene != nullptr && (points != nullptr || count == 0), "scene or points is NULL");
    requireThreads(threads);
    requireReach(points, 3 * count, "points must be finite, and within 1e15 m of the origin");
    onThreads(threads, [&, stop = EndsEarly::ofThisThread()] {
      oneapi::tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
        throwIfStopped(stop);
        const NearestPoint found = nearestPoint(SceneAt(*scene->snapshot), vecAt(points, i));
        put(nearest, i, found.at.point);
        put(normal, i, found.at.normal);
        if (distance != nullptr) distance[i] = found.at.distance;
        if (primitive != nullptr) primitive[i] = numberInModel(*scene->snapshot, found.primitive);
      });
    });
  });
}
