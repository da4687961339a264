// The options of a SCENE: its name, how its file becomes surfaces, its size, and how primitives are found. The same for
// all commands; load_snapshot.h makes the scene.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "io/cad_file.h"
#include "scene/shape.h"

namespace hl {

struct SceneOptions {
  std::string scene = "teapot";
  std::string hierarchy = "bvh";
  double scale = 0;            ///< metres per file unit; 0: as it is
  double fit = 0;              ///< m, largest side; 0: as it is
  std::string grid;            ///< of a file with several grids, by its name
  std::vector<double> iso;     ///< of volumes; empty: one that is chosen
  std::optional<bool> below;   ///< whether the matter of volumes is below iso; nothing: as the scene says
  double vertical_scale = 0;   ///< of the heights of height fields; 0: as they are
  bool surfels = false;        ///< of clouds, in place of points
  double surfel_reach = 0.75;  ///< in spacings
  CadMeshing cad;              ///< of CAD files
  bool opens_files = false;    ///< others, later on
  bool operator==(const SceneOptions&) const = default;
};

// `options` must outlive `command`.
void addSceneArgument(CLI::App& command, SceneOptions& options, bool required);
void addHierarchyOption(CLI::App& command, SceneOptions& options);
/// --vertical-scale, --grid, --iso, --below, --surfels and --deflection: how files become surfaces. addSizeOptions()
/// adds them too.
void addReadingOptions(CLI::App& command, SceneOptions& options);
/// --scale and --fit.
void addSizeOptions(CLI::App& command, SceneOptions& options);

/// Throws hl::Error if there is no scene, and an option says how it is to be read.
void requireNoReading(const SceneOptions& options);
HierarchyKind hierarchyOf(const SceneOptions& options);

}  // namespace hl
