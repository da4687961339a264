// The options of a SCENE: its name, how its file becomes surfaces, its size, and how primitives are found. The same for
// all commands; load_snapshot.h makes the scene.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "io/cad_file.h"
#include "scene/shape.h"
#include "surfaces/iso_cells.h"

namespace hl {

struct SceneOptions {
  std::string scene = "teapot";
  HierarchyKind hierarchy = HierarchyKind::kBvh;
  std::optional<double> scale;           ///< metres per file unit; absent: as it is
  std::optional<double> fit;             ///< m, largest side; absent: as it is
  std::string grid;                      ///< of a file with several grids, by its name
  std::vector<double> iso;               ///< of volumes; empty: one that is chosen
  std::optional<SolidSide> solid;        ///< where the matter of volumes is; absent: as the scene says
  std::optional<double> vertical_scale;  ///< of the heights of height fields; absent: as they are
  bool surfels = false;                  ///< of clouds, in place of points
  double surfel_reach = 0.75;            ///< in spacings
  CadMeshing cad;                        ///< of CAD files
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

}  // namespace hl
