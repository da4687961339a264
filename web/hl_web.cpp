#include "hl_web.h"

#include <cmath>
#include <exception>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "base/error.h"
#include "builtin.h"
#include "put.h"
#include "scene/weld.h"
#include "session.h"
#include "tools/trace.h"

namespace {

std::unique_ptr<hl::WebSession> session;
std::string last_error;

/// 1, or 0 with the reason in last_error.
template <typename Do>
int tried(const Do& act) {
  try {
    act();
    return 1;
  } catch (const std::exception& error) {
    last_error = error.what();
    return 0;
  }
}

void start(hl::SceneModel scene) {
  auto snapshot = hl::makeSnapshot(std::move(scene));
  if (snapshot->primitives == 0) throw hl::Error("nothing in this model can be touched: it has no valid triangle");
  session = std::make_unique<hl::WebSession>(std::move(snapshot));
}

hl::Model meshModel(const char* name, const double* positions, std::uint32_t vertices, const std::uint32_t* indices,
                    std::uint32_t triangles) {
  if (triangles == 0) throw hl::Error("there is no triangle in it");
  if (triangles > kHlWebMostTriangles) throw hl::Error("it has more than a million triangles");
  hl::Model model;
  model.name = name;
  for (std::uint32_t i = 0; i < vertices; ++i) model.positions.emplace_back(hl::Vec3::Map(positions + 3 * i));
  for (std::uint32_t i = 0; i < triangles; ++i) {
    const std::uint32_t* corner = indices + 3 * i;
    for (int k = 0; k < 3; ++k) {
      if (corner[k] >= vertices) throw hl::Error("a triangle of this model has a corner that does not exist");
    }
    model.triangles.push_back({corner[0], corner[1], corner[2]});
  }
  hl::weldVertices(model);
  return model;
}

hl::TraceSettings traceSettings(double radius, const double* surface, int smooth) {
  hl::TraceSettings trace;
  hl::ProxySettings& settings = trace.proxy;
  settings.radius = radius;
  for (std::size_t i = 0; i < hl::kNumbers; ++i) {
    if (!std::isnan(surface[i])) settings.surfaces.number(i) = surface[i];
  }
  if (smooth >= 0) settings.surfaces.smooth = smooth == 1;
  return trace;
}

std::vector<hl::PathSample> pathOf(const double* path, int rows) {
  std::vector<hl::PathSample> samples;
  for (int i = 0; i < rows; ++i) samples.push_back({path[4 * i], hl::Vec3::Map(path + 4 * i + 1)});
  return samples;
}

// One line for each quantity of base/quantities.def, in their order.
std::string quantityLines() {
  std::ostringstream lines;
  lines.precision(17);
  for (const hl::QuantityInfo& info : hl::kQuantityInfo) {
    lines << info.field << '\t' << hl::plainName(info) << '\t' << info.unit << '\t' << info.usual << '\t'
          << info.otherwise << '\t' << info.words << '\n';
  }
  return lines.str();
}

}  // namespace

static_assert(hl::kNumbers == kHlWebQuantities && hl::kEnergyCauses == kHlWebCauses &&
              hl::kEndings == kHlWebEndings + 1);

const char* hlWebError() { return last_error.c_str(); }

int hlWebLoadBuiltin(const char* name) {
  return tried([&] { start(hl::makeBuiltinWorld(name)); });
}

const char* hlWebScenes() { return hl::kBuiltinScenes; }
const char* hlWebQuantities() {
  static const std::string lines = quantityLines();
  return lines.c_str();
}

int hlWebLoadMesh(const char* name, const double* positions, std::uint32_t vertices, const std::uint32_t* indices,
                  std::uint32_t triangles) {
  return tried([&] { start(meshModel(name, positions, vertices, indices, triangles)); });
}

const HlWebScene* hlWebScene() { return &session->scene(); }
const char* hlWebName(int object) { return session->sent().name(object); }
void hlWebDraw(int object, std::uint32_t triangles) { session->sent().draw(object, triangles); }
const HlWebObject* hlWebObject(int object) { return &session->sent().object(object); }
const double* hlWebPositions(int object) { return session->sent().model(object).positions.data()->data(); }
const double* hlWebNormals(int object) { return session->sent().model(object).normals.data()->data(); }
const std::uint32_t* hlWebTriangles(int object) { return session->sent().model(object).triangles.data()->data(); }
const std::uint32_t* hlWebSegments(int object) { return session->sent().model(object).segments.data()->data(); }
const std::uint8_t* hlWebColours(int object) { return session->sent().colours(object).data()->data(); }
const double* hlWebStarts() { return session->sent().starts(); }
const double* hlWebPoses() { return session->sent().posesAt(session->now_ns()); }
const HlWebJoint* hlWebJoint(int joint) { return &session->sent().joint(joint); }
const HlWebPlace* hlWebPlace(int place) { return &session->sent().place(place); }
const double* hlWebPoints(int place) { return session->sent().points(place); }
const HlWebVolume* hlWebVolume(int volume) { return &session->sent().volume(volume); }

int hlWebIso(int volume, double value, int below) {
  return tried([&] { session->setIso(volume, {value, below != 0 ? hl::SolidSide::kBelow : hl::SolidSide::kAbove}); });
}

void hlWebStep(int steps) { session->step(steps); }
const HlWebState* hlWebState() { return &session->state(); }
const char* hlWebFault() { return session->fault(); }
void hlWebGoal(double x, double y, double z) { session->setGoal({x, y, z}); }
void hlWebRelease() { session->release(); }
void hlWebPress(std::uint32_t buttons) { session->press(buttons); }
void hlWebTurn(double x, double y, double z, double w) { session->turn({w, x, y, z}); }
void hlWebRearm() { session->rearm(); }
void hlWebExplore(int on) { session->setExplore(on != 0); }
void hlWebFirm(int firm) { session->setFirm(firm != 0); }
void hlWebStiffness(double stiffness_N_m) { session->setStiffness(stiffness_N_m); }

void hlWebLedger(int mode) {
  if (mode >= 0 && mode <= 2) session->setLedger(static_cast<hl::LedgerMode>(mode));
}

void hlWebSurface(int quantity, double value) {
  std::optional<double>& number = session->surfaces().number(static_cast<std::size_t>(quantity));
  number.reset();
  if (std::isfinite(value)) number = std::clamp(value, 0.0, hl::kQuantityInfo[quantity].most_set);
}

void hlWebLook(int smooth, int textures) {
  hl::MaterialOverride& surfaces = session->surfaces();
  surfaces.smooth.reset();
  if (smooth >= 0) surfaces.smooth = smooth == 1;
  surfaces.textures = textures != 0;
}

int hlWebTrace(const char* builtin, double radius, const double* surface, int smooth, const double* path, int rows,
               double* out) {
  return tried([&] {
    const auto snapshot = hl::makeSnapshot(hl::makeBuiltinWorld(builtin));
    hl::runTrace(*snapshot, traceSettings(radius, surface, smooth), pathOf(path, rows), [&](const hl::TraceRow& row) {
      out = hl::put(hl::put(hl::put(out, row.proxy), row.target), row.force);
      *out++ = row.contacts;
      *out++ = row.iterations;
      *out++ = row.injected_J;
      *out++ = static_cast<double>(row.world.hash >> 32);
      *out++ = static_cast<double>(row.world.hash & 0xffffffffU);
    });
  });
}
