#include "io/load_model.h"

#include <fcntl.h>
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <limits>

#include "base/error.h"
#include "base/open_file.h"
#include "base/plain_file.h"
#include "io/file_ending.h"
#include "io/isolated.h"
#include "io/read_clouds.h"
#include "io/read_heights.h"
#include "io/read_volumes.h"
#include "io/vdb_file.h"
#include "scene/split_model.h"
#include "scene/weld.h"

namespace hl {

namespace {

bool coinReads(const std::string& ending) {
  constexpr std::array<const char*, 4> kEndings{".wrl", ".vrml", ".iv", ".wrz"};
  return std::find(kEndings.begin(), kEndings.end(), ending) != kEndings.end();
}

void checkReadable(const std::string& path) {
  checkPlainFile(path);
  std::error_code error;
  if (std::filesystem::file_size(path, error) == 0) throw Error(path + ": is empty");
}

// Removes the elements that are bad, and their numbers in lists that have one for each; returns how many.
template <typename List, typename Bad, typename... Numbers>
std::size_t dropWhere(List& elements, Bad bad, Numbers&... numbers) {
  std::size_t kept = 0;
  const auto move_number = [&](auto& list, std::size_t from) {
    if (from < list.size()) list[kept] = list[from];
  };
  for (std::size_t i = 0; i < elements.size(); ++i) {
    if (bad(elements[i])) continue;
    elements[kept] = elements[i];
    (move_number(numbers, i), ...);
    ++kept;
  }
  const std::size_t dropped = elements.size() - kept;
  elements.resize(kept);
  (numbers.resize(std::min(kept, numbers.size())), ...);
  return dropped;
}

// Elements that refer to vertices that do not exist are left out, with a count.
void dropBadIndices(Model& model) {
  const auto bad = [&](std::uint32_t index) { return index >= model.positions.size(); };
  const std::size_t dropped =
      dropWhere(
          model.triangles, [&](const auto& t) { return bad(t[0]) || bad(t[1]) || bad(t[2]); }, model.triangle_materials,
          model.appearance.triangle_paints) +
      dropWhere(
          model.segments, [&](const auto& s) { return bad(s[0]) || bad(s[1]); }, model.segment_materials) +
      dropWhere(model.points, bad, model.point_materials);
  if (dropped > 0)
    model.warnings.push_back("skipped " + std::to_string(dropped) + " elements with vertices that do not exist");
}

// A list that is not one for each vertex is none; what is no number is zero.
template <typename Vector>
void keepFinite(std::vector<Vector>& list, std::size_t vertices) {
  if (list.size() != vertices) list.clear();
  for (Vector& v : list) {
    if (!v.allFinite()) v.setZero();
  }
}

// A scan may be vertices and nothing else: then each is a point. Where a file has any face or edge, vertices without
// one are left over from modelling.
void makePointsOfBareVertices(Model& model) {
  if (model.elements() > 0) return;
  for (std::uint32_t i = 0; i < model.positions.size(); ++i) model.points.push_back(i);
}

// By a program of its own.
SceneModel readByProgram(const std::string& path, const std::string& ending, const LoadOptions& options) {
  const OpenFile opened(open(path.c_str(), O_RDONLY | O_CLOEXEC));
  const int file = opened.descriptor();
  if (file < 0) throw Error(path + ": may not be read");
  const std::atomic<bool> given_up{false};
  if (readsVdb(ending)) return readVdb(file, path, {ending, options.grid}, options.limits, given_up, options.progress);
  return readCad(file, path, {ending, options.cad}, options.limits, given_up, options.progress);
}

// Both readers keep coordinates as float, whatever the file has: far from the origin few digits are left for the shape.
void warnOfLostDigits(Model& model) {
  constexpr double kCoarse = 1e-4;  // of the size
  Box bounds;
  for (const Vec3& p : model.positions) bounds.extend(p);
  if (model.triangles.size() + model.segments.size() == 0 || bounds.empty()) return;
  const double farthest = std::max(bounds.max.cwiseAbs().maxCoeff(), bounds.min.cwiseAbs().maxCoeff());
  const double spacing = std::numeric_limits<float>::epsilon() * farthest, size = bounds.size().norm();
  if (!(spacing > kCoarse * size)) return;
  model.warnings.push_back(
      fmt::format("it lies {:.2g} m from the origin, where coordinates are read to {:.2g} m only, and is {:.2g} m in "
                  "size: move it to the origin before it is saved",
                  bounds.centre().norm(), spacing, size));
}

void makeSound(Model& model) {
  makePointsOfBareVertices(model);
  dropBadIndices(model);
  keepFinite(model.normals, model.positions.size());
  keepFinite(model.texcoords, model.positions.size());
  dropPlainAppearance(model.appearance);
  warnOfLostDigits(model);
  model.reading = {weldVertices(model), true};
}

}  // namespace

bool readsEnding(const std::string& ending) {
  return readsCad(ending) || readsVdb(ending) || readsVolumes(ending) || readsHeights(ending) || readsClouds(ending) ||
         coinReads(ending) || assimpReads(ending);
}

std::string cannotBeRead(const std::string& ending) {
  if (const std::string advice = cloudAdvice(ending); !advice.empty()) return advice;
  if (ending.size() <= 1) return "has no ending (as .obj), by which its format is known";
  return "files ending in '" + ending +
         "' cannot be read; obj, ply, stl, gltf, glb, x3d, wrl, step, iges, brep, tif, hgt, asc, png, npy, nii, nrrd, "
         "dcm, vdb, las, pcd, xyz and others can";
}

SceneModel parseModel(const ModelFile& file, const ReadingReport& report) {
  if (readsVolumes(file.ending) || isDicomFolder(file.path)) {
    readVolume(file, report.volume());
    return {};
  }
  if (readsHeights(file.ending)) {
    readHeights(file, report.heights());
    return {};
  }
  if (readsClouds(file.ending) || (file.ending == ".ply" && !file.mesh && isPlyOfPoints(file.path))) {
    readCloud(file, report.cloud());
    return {};
  }
  SceneModel scene = coinReads(file.ending) ? SceneModel(parseWithCoin(file, report)) : parseWithAssimp(file, report);
  if (file.ending == ".ply" && !file.mesh && isPlyOfListedPoints(file.path))
    scene.model.warnings.emplace_back(
        "its vertices have a list among their properties: they are the points of a mesh, and no cloud; save them "
        "without lists for one");
  makeSound(scene.model);
  for (SceneBody& body : scene.bodies) makeSound(body.model);
  return scene;
}

SceneModel loadModelScene(const std::string& path, const LoadOptions& options) {
  std::error_code failed;
  const bool folder = std::filesystem::is_directory(path, failed);
  if (folder && !isDicomFolder(path))
    throw Error(path + ": is a folder, and no DICOM file is in it; folders beneath it are not searched");
  if (!folder) checkReadable(path);
  const std::string ending = folder ? "" : endingOf(path);
  if (!folder && !readsEnding(ending)) throw Error(path + ": " + cannotBeRead(ending));
  if (!options.grid.empty() && !readsVdb(ending)) throw Error(path + ": " + kNoGrids);
  const auto read_isolated = [&] {
    const auto parse = [&](const auto& report) { return parseModel({path, ending, false, options.mesh}, report); };
    return runIsolated(path, options.limits, parse, options.progress);
  };
  const bool by_program = readsCad(ending) || readsVdb(ending);
  SceneModel scene = by_program ? readByProgram(path, ending, options) : read_isolated();
  if (elementsIn(scene) == 0) {
    const auto& warnings = scene.model.warnings;
    throw Error(path + ": there is no geometry in it" + (warnings.empty() ? "" : ": " + warnings.front()));
  }
  scene.model.name = std::filesystem::path(path).filename().string();
  for (SceneSurface& surface : scene.surfaces) surface.name = scene.model.name;
  if (options.progress) options.progress(1);
  return scene;
}

Model loadModel(const std::string& path, const LoadOptions& options) {
  LoadOptions as_mesh = options;
  as_mesh.mesh = true;
  SceneModel scene = loadModelScene(path, as_mesh);
  if (!scene.surfaces.empty()) throw Error(path + ": is a height field, a volume or a cloud, and no mesh");
  asOneObject(scene.model);
  if (scene.bodies.empty()) return std::move(scene.model);
  scene.model.warnings.emplace_back("its bodies stay where they are: it is read as one object");
  return asOneModel(scene);
}

}  // namespace hl
