// EditableScene: the objects that one client has defined, and those of them that are in the world. Each edit is one
// frame: it is applied completely or not at all.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "base/memory_budget.h"
#include "scene/compliance.h"
#include "scene/placed_shape.h"
#include "scene/scene_items.h"
#include "scene/scene_limits.h"
#include "scene/stretched_shapes.h"

namespace hl {

/// One frame. Deletions are applied before definitions.
struct SceneEdit {
  std::vector<std::string> deleted_textures;
  std::vector<std::uint32_t> deleted_objects;
  std::map<std::string, std::shared_ptr<const Texture>> textures;
  std::map<std::uint32_t, std::shared_ptr<SceneItems>> objects;
  std::map<std::uint32_t, Compliance> compliances;  ///< by object; kept until the object is deleted
  std::shared_ptr<SceneItems> world;                ///< null: unchanged
  /// The client deforms its objects by the forces that it reads: how they yield is estimated where it does not say.
  bool answers_force = false;
};

/// Used by one thread at a time. prepare() may take long, as it makes scaled shapes. Memory is counted in `memory` from
/// before it is allocated until its last owner releases it.
class EditableScene {
 public:
  /// The scene after an edit, prepared but not yet shown.
  class Next {
   public:
    const PlacedList& placed() const { return *placed_; }

   private:
    friend class EditableScene;
    DefinedScene state_;
    PlacedShapes placed_;
    StretchedShapes stretched_;
  };

  EditableScene(std::uint32_t session, const SceneLimits& limits, MemoryBudget memory = {})
      : session_(session), limits_(limits), memory_(std::move(memory)) {}

  /// Throws hl::Error if a limit is exceeded, memory is short, calls form a cycle, or a texture is missing.
  Next prepare(SceneEdit edit) const;
  /// The current scene with `rebuilt` in place of `old`.
  Next prepareReplaced(const std::shared_ptr<const Shape>& old, const std::shared_ptr<const Shape>& rebuilt) const;
  /// Shows the scene that was prepared last; there must have been no edit since. Afterwards `next` holds the previous
  /// scene.
  void show(Next& next) noexcept;
  /// prepare() and show(). If it throws, nothing has changed.
  void apply(SceneEdit edit);

  /// The shapes in the world now.
  const PlacedList& placed() const { return *placed_; }
  const PlacedShapes& sharedPlaced() const { return placed_; }
  std::size_t primitives() const;  ///< in the world, total over all instances
  /// Items of an object, or of the world for 0; null if there is no such object. Valid until the next edit.
  const SceneItems* items(std::uint32_t object) const;

  /// A shape in the world whose hierarchy has a cost ratio above kMaxCostRatio; null if there is none.
  std::shared_ptr<const Shape> toRebuild() const;

 private:
  DefinedScene after(SceneEdit edit) const;
  void checkLimits(const DefinedScene& state) const;

  const std::uint32_t session_;
  const SceneLimits limits_;
  const MemoryBudget memory_;
  DefinedScene state_;
  PlacedShapes placed_ = std::make_shared<PlacedList>();
  StretchedShapes stretched_;  // copies in use
};

}  // namespace hl
