// Scene items: what one client has defined, before it is placed. Objects place shapes and call each other, as GL's
// display lists do; the world says which of them are there. Each object has a frame of its own, and the placements that
// lead from the world to it make metres of its lengths. Immutable where shared; any thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/memory_budget.h"
#include "scene/compliance.h"
#include "scene/placed_joints.h"
#include "scene/shape.h"
#include "scene/surface_change.h"

namespace hl {

/// A shape, or a call of another object, placed in the frame of its own object. The structure is small, as a message of
/// a few megabytes may contain a million items; members that are usually absent are stored separately.
struct SceneItem {
  std::shared_ptr<const Shape> shape;              ///< empty: the item is a call
  std::uint32_t call = 0;                          ///< id of the called object; an unknown id has no effect
  std::optional<std::uint32_t> name;               ///< absent: the name of the caller
  std::shared_ptr<const Placement> placement;      ///< invertible, may scale and shear; null: identity
  std::shared_ptr<const SurfaceChange> surface{};  ///< null: the surface of the caller
};
struct SceneItems : std::vector<SceneItem> {
  using std::vector<SceneItem>::vector;
  std::shared_ptr<const BodySpec> body{};     ///< each shape that it places directly is a rigid body; null: none is
  std::shared_ptr<const SnapList> snaps{};    ///< of each call of the object; null: none
  std::shared_ptr<const FieldList> fields{};  ///< the same
  std::vector<CalledJoint> joints;            ///< of the world; objects have none
};

/// All of one client.
struct DefinedScene {
  std::map<std::string, std::shared_ptr<const Texture>> textures;
  std::map<std::uint32_t, std::shared_ptr<const SceneItems>> objects;
  std::map<std::uint32_t, Compliance> compliances;  ///< of objects that are there
  std::shared_ptr<const SceneItems> world = std::make_shared<SceneItems>();
  bool answers_force = false;  ///< its client deforms it by the forces that it reads
};

/// Memory of an object without its items, and of a texture without its texels: an entry in two maps while edited.
inline constexpr std::size_t kObject_bytes = 512;
/// Memory of a list of `count` items.
std::size_t bytesOfItems(std::size_t count);
/// Memory of the separately stored members of an item, without its shape.
std::size_t bytesApart(const SceneItem& item);
/// A copy that shares the shapes. Throws hl::Error if there is no memory for it.
std::shared_ptr<SceneItems> copyOf(const SceneItems& items, const MemoryBudget& budget);

}  // namespace hl
