// Scene model: a scene as a file or a generator describes it: what stays where it is, as one model, and the rigid
// bodies, each with a model of its own.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "scene/mechanics.h"
#include "scene/rigid_body.h"
#include "scene/snapshot.h"
#include "surfaces/iso_cells.h"

namespace hl {

struct SceneBody {
  std::string name;
  Model model;  ///< object frame
  Pose pose;
  BodySpec spec;
  SnapList snaps{};    ///< object frame
  FieldList fields{};  ///< object frame
};

/// A surface that is not a mesh. Metres, world frame.
struct SceneSurface {
  std::string name;
  std::shared_ptr<const PrimitiveSource> source;
  Material material{};
  std::vector<Texture> textures{};  ///< that the material uses
  Vec2 repeat = Vec2::Ones();       ///< texture coordinates are multiplied by it
  std::optional<Rgb> colour{};      ///< as Label has it
  Appearance appearance{};          ///< with a picture: one paint
};

/// Metres, world frame.
struct SceneModel {
  SceneModel() = default;
  SceneModel(Model at_rest) : model(std::move(at_rest)) {}  // NOLINT: implicit, as a model is a scene
  Model model;                                              ///< what stays; its name and warnings are the scene's
  SnapList snaps;                                           ///< of what stays
  FieldList fields;                                         ///< of what stays
  std::vector<SceneSurface> surfaces;                       ///< that stay
  std::vector<SceneBody> bodies;
  Mechanics mechanics;  ///< its joints number the bodies from 1 in their order
};

Box boundsOf(const SceneModel& scene);
std::size_t elementsIn(const SceneModel& scene);
std::size_t bytesToMake(const SceneModel& scene);
/// All of it where it starts, with one material for each object. Textures are left out. Throws hl::Error if it has a
/// surface that is not a mesh.
Model asOneModel(const SceneModel& scene);
/// As those of a model. Lengths change, also those from which snaps capture, and the reach of fields; masses, densities
/// and accelerations stay as they are said.
void scaleModel(SceneModel& scene, double factor);
double fitModel(SceneModel& scene, double side);
/// Scales the heights, y, of its height fields. Throws hl::Error if it has none.
void scaleHeights(SceneModel& scene, double factor);

/// In the place of each volume's surfaces, one at each of these values, with the names and materials of those in order;
/// values beyond them have those of the last. Throws hl::Error if it has no volume, or if two values are equal.
void setIsoValues(SceneModel& scene, const std::vector<double>& values);
/// The matter of each volume's surfaces is on this side of their values. Throws hl::Error if it has no volume.
void setSolidSide(SceneModel& scene, SolidSide solid);
/// Clouds of points become surfels, each reaching so many spacings around its point. Throws hl::Error if there are no
/// clouds.
void setSurfels(SceneModel& scene, double reach);

std::size_t snapsIn(const SceneModel& scene);
std::size_t fieldsIn(const SceneModel& scene);

/// The model has key 1, if it has elements, snaps or fields; surfaces and then bodies follow in their order. Allocates;
/// never called by a real-time thread.
std::shared_ptr<const Snapshot> makeSnapshot(SceneModel scene, HierarchyKind hierarchy = HierarchyKind::kBvh);
/// The same scene with its bodies where they started, apart from those of `snapshot`: what moves the ones does not move
/// the others. Null: it has no bodies.
std::shared_ptr<const Snapshot> withOwnBodies(const Snapshot& snapshot);

}  // namespace hl
