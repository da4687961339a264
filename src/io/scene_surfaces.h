// SceneSurfaces: the objects of a scene file that are no meshes: height fields, volumes, clouds, implicit surfaces.
#pragma once

#include <hl.pb.h>

#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "io/decode_clouds.h"
#include "io/decode_volumes.h"
#include "io/load_model.h"
#include "scene/scene_model.h"

namespace hl {

class SceneSurfaces {
 public:
  /// Files are relative to `folder`. Both must outlive it.
  SceneSurfaces(const std::filesystem::path& folder, const LoadOptions& options) : folder_(folder), options_(options) {}

  /// Whether the object is such surfaces.
  static bool has(const proto::SceneObject& object);
  /// Name of the field of the object that says what it is: "volume".
  static const char* fieldOf(const proto::SceneObject& object);
  /// Its file; empty: it has none.
  static const std::string& fileOf(const proto::SceneObject& object);
  /// One, or all of a builtin, as they are before the object's transform. Throws hl::Error.
  std::vector<SceneSurface> read(const proto::SceneObject& object);
  /// What the readers of files had to say since the last call.
  std::vector<std::string> takeWarnings() { return std::exchange(warnings_, {}); }

 private:
  std::shared_ptr<const PrimitiveSource> heights(const proto::Heights& in);
  std::shared_ptr<const PrimitiveSource> volume(const proto::Volume& in);
  std::shared_ptr<const PrimitiveSource> cloud(const proto::Cloud& in);
  SceneModel named(const std::string& builtin, const std::string& file, const std::string& grid = {});
  SceneModel load(const std::string& file, const std::string& grid = {});

  const std::filesystem::path& folder_;
  const LoadOptions& options_;
  std::vector<std::string> warnings_;
  // Read once, however many objects show them.
  std::map<std::string, PlacedVolume> volumes_;
  std::map<std::string, std::shared_ptr<const PointCloud>> clouds_;
};

}  // namespace hl
