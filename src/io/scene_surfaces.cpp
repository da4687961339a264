#include "io/scene_surfaces.h"

#include "base/error.h"
#include "builtin.h"
#include "io/decode_heights.h"
#include "io/decode_implicit.h"

namespace hl {

bool SceneSurfaces::has(const proto::SceneObject& object) {
  return object.has_heights() || object.has_volume() || object.has_cloud() || object.has_implicit() ||
         (object.has_builtin() && isBuiltinSurface(object.builtin()));
}

const char* SceneSurfaces::fieldOf(const proto::SceneObject& object) {
  if (object.has_builtin()) return "builtin";
  if (object.has_cloud()) return "cloud";
  if (object.has_implicit()) return "implicit";
  return object.has_volume() ? "volume" : "heights";
}

const std::string& SceneSurfaces::fileOf(const proto::SceneObject& object) {
  if (object.has_cloud()) return object.cloud().file();
  return object.has_volume() ? object.volume().file() : object.heights().file();
}

std::vector<SceneSurface> SceneSurfaces::read(const proto::SceneObject& object) {
  if (object.has_builtin()) return makeBuiltinWorld(object.builtin()).surfaces;
  SceneSurface surface;
  if (object.has_implicit()) {
    surface.source = decodeImplicit(object.implicit());
  } else if (object.has_cloud()) {
    surface.source = cloud(object.cloud());
  } else {
    surface.source = object.has_volume() ? volume(object.volume()) : heights(object.heights());
  }
  return {surface};
}

SceneModel SceneSurfaces::load(const std::string& file, const std::string& grid) {
  LoadOptions options = options_;
  options.grid = grid;
  SceneModel scene = loadModelScene((folder_ / file).string(), options);
  for (const std::string& warning : scene.model.warnings) warnings_.push_back(file + ": " + warning);
  return scene;
}

std::shared_ptr<const PrimitiveSource> SceneSurfaces::heights(const proto::Heights& in) {
  if (in.file().empty()) return decodeHeights(in);
  const SceneModel scene = load(in.file());
  if (scene.surfaces.empty() || dynamic_cast<const HeightField*>(scene.surfaces.front().source.get()) == nullptr)
    throw Error(in.file() + ": is no file of heights");
  return withSpacing(scene.surfaces.front().source, in);
}

// What one of them names.
SceneModel SceneSurfaces::named(const std::string& builtin, const std::string& file, const std::string& grid) {
  if (!builtin.empty() && !file.empty()) throw Error("it has a file or a builtin, not both");
  return builtin.empty() ? load(file, grid) : makeBuiltinWorld(builtin);
}

std::shared_ptr<const PrimitiveSource> SceneSurfaces::volume(const proto::Volume& in) {
  if (in.builtin().empty() && in.file().empty()) return isoSurfaceOf(decodeVolume(in), isoChoiceOf(in), matterOf(in));
  const std::string& name = in.builtin().empty() ? in.file() : in.builtin();
  const auto [place, fresh] = volumes_.try_emplace(in.builtin() + '\n' + in.file() + '\n' + in.grid());
  if (fresh) {
    const SceneModel scene = named(in.builtin(), in.file(), in.grid());
    const auto* const first =
        scene.surfaces.empty() ? nullptr : dynamic_cast<const IsoSurface*>(scene.surfaces.front().source.get());
    if (first == nullptr) throw Error(name + ": is no volume");
    place->second = {first->volume(), first->frame()};
    if (in.builtin().empty()) place->second.iso = first->iso();
  }
  return isoSurfaceOf(withSpacing(place->second, in), isoChoiceOf(in), matterOf(in));
}

std::shared_ptr<const PrimitiveSource> SceneSurfaces::cloud(const proto::Cloud& in) {
  if (in.builtin().empty() && in.file().empty()) return decodeCloud(in);
  std::shared_ptr<const PointCloud>& cloud = clouds_[in.builtin() + '\n' + in.file()];
  if (!cloud) {
    const SceneModel scene = named(in.builtin(), in.file());
    if (!scene.surfaces.empty()) cloud = std::dynamic_pointer_cast<const PointCloud>(scene.surfaces.front().source);
    if (!cloud) {
      const std::vector<std::string>& said = scene.model.warnings;  // of a file that could be one
      throw Error((in.builtin().empty() ? in.file() : in.builtin()) + ": is no cloud of points" +
                  (said.empty() ? "" : ": " + said.front()));
    }
  }
  return withLook(*cloud, in);
}

}  // namespace hl
