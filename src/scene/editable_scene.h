// EditableScene: the objects of one client: what it has defined, and what of that is in the world. Each edit is one
// frame: it happens as a whole or not at all.
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
#include "scene/shape.h"
#include "scene/snapshot.h"
#include "scene/surface_change.h"

namespace hl {

/// A shape, or a call of another object; placed in the frame of the object it belongs to. Small, as a message of a few
/// megabytes may hold a million: what most leave out is kept apart.
struct SceneItem {
  std::shared_ptr<const Shape> shape;              ///< or empty:
  std::uint32_t call = 0;                          ///< id of the object called; one that does not exist is nothing
  std::optional<std::uint32_t> name;               ///< absent: the caller's
  std::shared_ptr<const Placement> placement;      ///< invertible; scales and shears too; null: in its object's frame
  std::shared_ptr<const SurfaceChange> surface{};  ///< null: the caller's
};
using SceneItems = std::vector<SceneItem>;
/// Memory that a list takes, of so many items.
std::size_t bytesOfItems(std::size_t count);
/// Memory that what an item keeps apart takes, but for its shape.
std::size_t bytesApart(const SceneItem& item);
/// Of the same shapes. Throws hl::Error when there is no memory for it.
std::shared_ptr<SceneItems> copyOf(const SceneItems& items, const MemoryBudget& budget);

/// One frame. First what is deleted, then what is new.
struct SceneEdit {
  std::vector<std::string> deleted_textures;
  std::vector<std::uint32_t> deleted_objects;
  std::map<std::string, std::shared_ptr<const Texture>> textures;
  std::map<std::uint32_t, std::shared_ptr<SceneItems>> objects;
  std::shared_ptr<SceneItems> world;  ///< null: as it is
};

/// What one client may have in its scene.
struct SceneLimits {
  std::uint64_t objects = 100'000;  ///< definitions, however short: see kObject_bytes
  /// Memory of its shapes with their hierarchies, by bytesToMake(); as much again for scaled copies. Some 45 million
  /// triangles.
  std::uint64_t scene_bytes = std::uint64_t{4} << 30;
  std::uint64_t instances = 100'000;  ///< objects in the world, each call counted
  std::uint64_t texture_bytes = std::uint64_t{256} << 20;
  std::uint32_t nesting = 32;  ///< calls within calls, as deep as GL's matrix stack
};

/// Memory that an object takes beside its items, and a texture beside its texels: in two maps while they are edited.
inline constexpr std::size_t kObject_bytes = 512;
/// Memory that a shape in the world takes, beside the shape: placed, and as an Instance of as many snapshots as there
/// are at once (two that the loops may be in, one that is made, two that the page draws), with its layouts.
std::size_t bytesInWorld();

/// Adds up what shapes will take against the limit.
class ModelSizes {
 public:
  explicit ModelSizes(const SceneLimits& limits) : most_bytes_(limits.scene_bytes) {}
  /// Throws hl::Error, with `where` in front, when there is more than the limits allow.
  void add(const Model& model, const std::string& where = {});

 private:
  const std::size_t most_bytes_;
  std::size_t bytes_ = 0;
};

/// A shape as it comes to rest in the world, before it is known how it gets there.
struct PlacedShape {
  std::shared_ptr<const Shape> shape;
  std::shared_ptr<const Surfaces> surfaces;
  Pose pose;
  std::uint64_t key = 0;  ///< by the calls that lead to it: the same from frame to frame
  std::uint32_t session = 0, object = 0, name = 0;
};

/// What is in the world; shared by all who show it.
using PlacedShapes = std::shared_ptr<const std::vector<PlacedShape>>;

/// Used by one thread at a time; prepare() may take long, as scaled shapes are made there. What is made is counted
/// against `memory` before it is, and until nobody has it any more.
class EditableScene {
 private:
  struct State {
    std::map<std::string, std::shared_ptr<const Texture>> textures;
    std::map<std::uint32_t, std::shared_ptr<const SceneItems>> objects;
    std::shared_ptr<const SceneItems> world = std::make_shared<SceneItems>();
  };
  /// The geometry of a shape and the stretch that it was made with: the upper half of a symmetric matrix.
  using Stretched = std::tuple<std::uint64_t, std::array<double, 6>>;

 public:
  /// The scene as it is to be next.
  class Next {
    friend class EditableScene;
    State state_;
    PlacedShapes placed_;
    std::map<Stretched, std::shared_ptr<const Shape>> stretched_;
  };

  EditableScene(std::uint32_t session, const SceneLimits& limits, MemoryBudget memory = {})
      : session_(session), limits_(limits), memory_(std::move(memory)) {}

  /// Throws hl::Error when a limit is passed, there is no memory, calls go in a circle, or a texture is missing.
  Next prepare(SceneEdit edit) const;
  /// The same with the shape that was rebuilt from `old` where that one was.
  Next prepareReplaced(const std::shared_ptr<const Shape>& old, const std::shared_ptr<const Shape>& rebuilt) const;
  /// What was prepared last, with no edit since. What was there before is in `next` then.
  void show(Next& next) noexcept;
  /// Both: the whole edit, or it throws and changes nothing.
  void apply(SceneEdit edit);

  /// What is in the world now.
  const std::vector<PlacedShape>& placed() const { return *placed_; }
  const PlacedShapes& sharedPlaced() const { return placed_; }
  std::size_t primitives() const;  ///< in the world, each instance counted
  /// Of an object, or of the world, 0; null where there is no such object. Until the next edit.
  const SceneItems* items(std::uint32_t object) const;

  /// A shape in the world whose hierarchy has a cost ratio above kMaxCostRatio; null when there is none.
  std::shared_ptr<const Shape> toRebuild() const;

 private:
  class Flattening;

  State after(SceneEdit edit) const;
  void checkLimits(const State& state) const;

  const std::uint32_t session_;
  const SceneLimits limits_;
  const MemoryBudget memory_;
  State state_;
  PlacedShapes placed_ = std::make_shared<std::vector<PlacedShape>>();
  std::map<Stretched, std::shared_ptr<const Shape>> stretched_;  // those in use
};

struct Followed {
  std::vector<Instance> instances;
  std::int64_t blend_ns = 0;  ///< for the next snapshot
  std::size_t jumps = 0;      ///< meshes that jump, as there is no memory for their motion
};

/// The instances of the next snapshot, from those of this client in the last one, both by rising key: what was there
/// moves from where it is at `begin_ns` to its new place until `end_ns`; what is new, or all when end_ns <= begin_ns,
/// is there at once. A mesh that deforms gets there in the same time, or in kAbruptBlend_ns; from where it is now.
/// What it needs for that is counted against `memory`; a mesh for which there is no room is there at once.
Followed followOn(const std::vector<PlacedShape>& placed, std::span<const Instance* const> last, std::int64_t begin_ns,
                  std::int64_t end_ns, const MemoryBudget& memory = {});

}  // namespace hl
