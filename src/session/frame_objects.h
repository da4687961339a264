// FrameObjects: the objects of a scene as they will be when a frame is shown: those that it defines and those of
// before.
#pragma once

#include <functional>
#include <set>
#include <string>

#include "scene/editable_scene.h"

namespace hl {

/// The items that an object has so far, null where there is none; object 0 is the world. A shape that comes in the
/// place of another follows on it: see makeShape.
using ItemsBefore = std::function<const SceneItems*(std::uint32_t object)>;

/// Messages name things as the client does: by the numbers of its objects and the names of its textures.
inline std::string pathOfItems(std::uint32_t object) {
  return object == 0 ? "world.items" : "object " + std::to_string(object) + ", items";
}

class FrameObjects {
 public:
  /// All must outlive it.
  FrameObjects(SceneEdit& edit, const ItemsBefore& before, const MemoryBudget& memory)
      : edit_(edit), before_(before), memory_(memory) {}

  const SceneItems* before(std::uint32_t object) const { return before_ ? before_(object) : nullptr; }
  /// Throws hl::Error if the frame has it already.
  void define(std::uint32_t object, std::shared_ptr<SceneItems> items);
  void remove(std::uint32_t object);
  bool isThere(std::uint32_t object) const;
  /// In the edit; what is not changed of an object stays as it was. Throws hl::Error if it is not there.
  SceneItems& toChange(std::uint32_t object, const std::string& where);

 private:
  SceneEdit& edit_;
  const ItemsBefore& before_;
  const MemoryBudget& memory_;
  std::set<std::uint32_t> removed_;
};

}  // namespace hl
