#include "io/scene_surfaces.h"

#include <utility>

#include "base/error.h"
#include "builtin.h"
#include "io/decode_heights.h"

namespace hl {

bool SceneSurfaces::has(const proto::SceneObject& object) {
  return object.has_heights() || object.has_volume() || (object.has_builtin() && isBuiltinSurface(object.builtin()));
}

const char* SceneSurfaces::fieldOf(const proto::SceneObject& object) {
  if (object.has_builtin()) return "builtin";
  return object.has_volume() ? "volume" : "heights";
}

const std::string& SceneSurfaces::fileOf(const proto::SceneObject& object) {
  return object.has_volume() ? object.volume().file() : object.heights().file();
}

std::vector<SceneSurface> SceneSurfaces::read(const proto::SceneObject& object) {
  if (object.has_builtin()) return makeBuiltinWorld(object.builtin()).surfaces;
  SceneSurface surface;
  surface.source = object.has_volume() ? volume(object.volume()) : heights(object.heights());
  return {surface};
}

SceneModel SceneSurfaces::load(const std::string& file) const {
  return loadModelScene((folder_ / file).string(), options_);
}

std::shared_ptr<const PrimitiveSource> SceneSurfaces::heights(const proto::Heights& in) const {
  if (in.file().empty()) return decodeHeights(in);
  const SceneModel scene = load(in.file());
  if (scene.surfaces.empty() || dynamic_cast<const HeightField*>(scene.surfaces.front().source.get()) == nullptr)
    throw Error(in.file() + ": is no file of heights");
  return withSpacing(scene.surfaces.front().source, in);
}

std::shared_ptr<const PrimitiveSource> SceneSurfaces::volume(const proto::Volume& in) {
  const bool built_in = !in.builtin().empty();
  if (!built_in && in.file().empty()) return isoSurfaceOf(decodeVolume(in), in);
  if (built_in && !in.file().empty()) throw Error("it has a file or a builtin, not both");
  const std::string& name = built_in ? in.builtin() : in.file();
  const auto [place, fresh] = volumes_.try_emplace((built_in ? "builtin " : "file ") + name);
  if (fresh) {
    const SceneModel scene = built_in ? makeBuiltinWorld(name) : load(name);
    const auto* const first =
        scene.surfaces.empty() ? nullptr : dynamic_cast<const IsoSurface*>(scene.surfaces.front().source.get());
    if (first == nullptr) throw Error(name + ": is no volume");
    place->second = {first->volume(), first->frame()};
  }
  return isoSurfaceOf(withSpacing(place->second, in), in);
}

}  // namespace hl
