// Model files: OBJ, PLY, STL, glTF and what else assimp reads; VRML 1.0 and 97 and Inventor through Coin; heights by
// read_heights.h, volumes by read_volumes.h and vdb_file.h, clouds by read_clouds.h; STEP, IGES and BREP by cad_file.h.
#pragma once

#include <cstddef>
#include <functional>
#include <string>

#include "io/cad_file.h"
#include "io/isolated.h"
#include "io/model_file.h"
#include "scene/scene_model.h"

namespace hl {

struct LoadOptions {
  IsolationLimits limits{};                       ///< of the process that reads a model file
  std::function<void(double fraction)> progress;  ///< called while reading, 0..1
  /// Of a scene file, all objects together: some 5 GB. A few lines can ask for any number of copies.
  std::size_t most_primitives = 40'000'000;
  std::size_t most_texels = std::size_t{256} << 20;  ///< of a scene file, all textures together: 1 GiB
  CadMeshing cad{};                                  ///< of CAD files
  std::string grid{};                                ///< of a file with several grids, by its name; others are refused
  bool alone = false;  ///< no file beside it is read: a scene file that names one is refused
  bool mesh = false;   ///< of a PLY file without faces: its points are those of a mesh, and no cloud
};

/// Reads a file as it is: node transforms applied, polygons triangulated, normals and texture coordinates kept, lines
/// and points too; vertices that are the same to the bit are joined. What was skipped is in the model's warnings.
/// Throws hl::Error, one line, for a file that cannot be used. Parses in a child process: call it before the program
/// starts threads.
/// Bodies that an X3D file describes are part of it, where they start.
Model loadModel(const std::string& path, const LoadOptions& options = {});
/// The same with its bodies.
SceneModel loadModelScene(const std::string& path, const LoadOptions& options = {});

/// Whether a reader takes files of this ending (".obj"), and the words for one that none takes.
bool readsEnding(const std::string& ending);
std::string cannotBeRead(const std::string& ending);

/// What the reader gives, made sound and small. In a process of its own; throws on failure.
SceneModel parseModel(const ModelFile& file, const ReadingReport& report);

/// For parseModel.
SceneModel parseWithAssimp(const ModelFile& file, const std::function<void(double)>& report);
Model parseWithCoin(const ModelFile& file, const std::function<void(double)>& report);
/// True when assimp has a reader for this ending (".obj").
bool assimpReads(const std::string& ending);

}  // namespace hl
