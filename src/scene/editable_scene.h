// EditableScene: the objects that one client has defined, and those of them that are in the world. Each edit is one
// frame: it is applied completely or not at all.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "base/memory_budget.h"
#include "scene/model.h"
#include "scene/placed_joints.h"
#include "scene/shape.h"
#include "scene/snapshot.h"
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
/// Memory of a list of `count` items.
std::size_t bytesOfItems(std::size_t count);
/// Memory of the separately stored members of an item, without its shape.
std::size_t bytesApart(const SceneItem& item);
/// A copy that shares the shapes. Throws hl::Error if there is no memory for it.
std::shared_ptr<SceneItems> copyOf(const SceneItems& items, const MemoryBudget& budget);

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

/// Limits for the scene of one client.
struct SceneLimits {
  std::uint64_t objects = 100'000;  ///< number of definitions of any size: see kObject_bytes
  /// Memory of its shapes with their hierarchies, by bytesToMake(), and the same again for scaled copies. About 45
  /// million triangles.
  std::uint64_t scene_bytes = std::uint64_t{4} << 30;
  std::uint64_t instances = 100'000;  ///< objects in the world, counting each call
  std::uint64_t texture_bytes = std::uint64_t{256} << 20;
  std::uint32_t nesting = 32;         ///< depth of nested calls, as for GL's matrix stack
  std::uint64_t bodies = kMaxBodies;  ///< in the world, that move
  std::uint64_t joints = kMaxJoints;  ///< in the world
};

/// Memory of an object without its items, and of a texture without its texels: an entry in two maps while edited.
inline constexpr std::size_t kObject_bytes = 512;
/// Memory of a shape in the world, without the shape itself: its placement, and an Instance with layout in each
/// snapshot that exists at the same time (two that the loops may use, one that is being made, two that the page draws).
std::size_t bytesInWorld();
/// Memory of a body that moves, beside that: in the worlds of three scenes the lists of a step have room for 64
/// contacts of each.
inline constexpr std::size_t kBody_bytes = 300'000;

/// Adds up the memory that shapes will need and checks it against the limit.
class ModelSizes {
 public:
  explicit ModelSizes(const SceneLimits& limits) : most_bytes_(limits.scene_bytes) {}
  /// Throws hl::Error, with the prefix `where`, if the sum exceeds the limit.
  void add(const Model& model, const std::string& where = {});
  void add(std::size_t bytes, const std::string& where = {});

 private:
  const std::size_t most_bytes_;
  std::size_t bytes_ = 0;
};

/// Used by one thread at a time. prepare() may take long, as it makes scaled shapes. Memory is counted in `memory` from
/// before it is allocated until its last owner releases it.
class EditableScene {
 private:
  struct State {
    std::map<std::string, std::shared_ptr<const Texture>> textures;
    std::map<std::uint32_t, std::shared_ptr<const SceneItems>> objects;
    std::map<std::uint32_t, Compliance> compliances;  // of objects that are there
    std::shared_ptr<const SceneItems> world = std::make_shared<SceneItems>();
    bool answers_force = false;
  };
  /// The geometry number of a shape, and the stretch applied to it: the upper half of a symmetric matrix.
  using Stretched = std::tuple<std::uint64_t, std::array<double, 6>>;

 public:
  /// The scene after an edit, prepared but not yet shown.
  class Next {
   public:
    const PlacedList& placed() const { return *placed_; }

   private:
    friend class EditableScene;
    State state_;
    PlacedShapes placed_;
    std::map<Stretched, std::shared_ptr<const Shape>> stretched_;
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
  class Flattening;

  State after(SceneEdit edit) const;
  void checkLimits(const State& state) const;

  const std::uint32_t session_;
  const SceneLimits limits_;
  const MemoryBudget memory_;
  State state_;
  PlacedShapes placed_ = std::make_shared<PlacedList>();
  std::map<Stretched, std::shared_ptr<const Shape>> stretched_;  // stretched copies in use
};

struct Followed {
  std::vector<Instance> instances;
  std::int64_t blend_ns = 0;  ///< blend_ns of the next snapshot
  std::size_t jumps = 0;      ///< meshes that change at once because there was no memory for a transition
};

/// The instances of the next snapshot, from those of this client in the last one; both sorted by key. An object that
/// existed moves from its pose at `begin_ns` to its new pose at `end_ns`. A new object is at its pose at once, as are
/// all if end_ns <= begin_ns. A mesh deforms in the same time, or in kAbruptBlend_ns; a transition that has begun is
/// completed first. The memory for this is counted in `memory`; a mesh for which there is no room changes at once. What
/// is no mesh always does, in the snapshot of the given number. A rigid body goes on from where it is while its start
/// is the same; `scene`: bounds of all that it may meet.
Followed followOn(const std::vector<PlacedShape>& placed, std::span<const Instance* const> last, std::int64_t begin_ns,
                  std::int64_t end_ns, const MemoryBudget& memory = {}, const Box& scene = {},
                  std::uint64_t snapshot = 1);

}  // namespace hl
