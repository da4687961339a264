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

/// A shape, or a call of another object; placed in the frame of the object it belongs to.
struct SceneItem {
  std::shared_ptr<const Shape> shape;  ///< or empty:
  std::uint32_t call = 0;              ///< id of the object called; one that does not exist is nothing
  Placement placement;                 ///< invertible; scales and shears too
  SurfaceChange surface;
  std::optional<std::uint32_t> name;  ///< absent: the caller's
};
using SceneItems = std::vector<SceneItem>;

/// One frame. First what is deleted, then what is new.
struct SceneEdit {
  std::vector<std::string> deleted_textures;
  std::vector<std::uint32_t> deleted_objects;
  std::map<std::string, std::shared_ptr<const Texture>> textures;
  std::map<std::uint32_t, SceneItems> objects;
  std::optional<SceneItems> world;  ///< absent: as it is
};

/// What one client may have.
struct SceneLimits {
  std::size_t objects = 65'536;
  std::size_t primitives = 40'000'000;  ///< as many again in scaled copies; and three times as many vertices
  std::size_t instances = 16'384;
  std::size_t texture_bytes = std::size_t{256} << 20;
  std::size_t nesting = 32;
};

/// Adds up models against the limits. Vertices count as well: some that nothing refers to fill memory all the same.
class ModelSizes {
 public:
  explicit ModelSizes(const SceneLimits& limits) : most_(limits.primitives) {}
  /// Throws hl::Error, with `where` in front, when there is more than the limits allow.
  void add(const Model& model, const std::string& where = {});

 private:
  const std::size_t most_;
  std::size_t primitives_ = 0, vertices_ = 0;
};

/// A shape as it comes to rest in the world, before it is known how it gets there.
struct PlacedShape {
  std::shared_ptr<const Shape> shape;
  std::shared_ptr<const Surfaces> surfaces;
  Pose pose;
  std::uint64_t key = 0;  ///< by the calls that lead to it: the same from frame to frame
  std::uint32_t session = 0, object = 0, name = 0;
};

/// Used by one thread at a time; apply() may take long, as scaled shapes are made there.
class EditableScene {
 public:
  EditableScene(std::uint32_t session, const SceneLimits& limits) : session_(session), limits_(limits) {}

  /// Throws hl::Error, and changes nothing, when a limit is passed, calls go in a circle, or a texture is missing. What
  /// scaled copies take is added to `memory`, which may throw.
  void apply(const SceneEdit& edit, MemoryShare& memory);
  void apply(const SceneEdit& edit);  ///< of memory that nobody counts
  /// What is in the world now.
  const std::vector<PlacedShape>& placed() const { return placed_; }
  std::size_t primitives() const;  ///< in the world, each instance counted
  std::size_t bytes() const;       ///< of shapes, scaled copies and textures, in the world or not
  /// Of an object, or of the world, 0; null where there is no such object. Until the next edit.
  const SceneItems* items(std::uint32_t object) const;

  /// One in the world whose hierarchy is worn beyond kMostWear; none when there is none.
  std::shared_ptr<const Shape> worn() const;
  /// Puts the shape that was rebuilt from `old` where that one was.
  void replace(const std::shared_ptr<const Shape>& old, const std::shared_ptr<const Shape>& rebuilt);

 private:
  struct State {
    std::map<std::string, std::shared_ptr<const Texture>> textures;
    std::map<std::uint32_t, std::shared_ptr<const SceneItems>> objects;
    std::shared_ptr<const SceneItems> world = std::make_shared<SceneItems>();
  };
  /// The geometry of a shape and the stretch that it was made with: the upper half of a symmetric matrix.
  using Stretched = std::tuple<std::uint64_t, std::array<double, 6>>;
  class Flattening;

  State after(const SceneEdit& edit) const;
  void checkLimits(const State& state) const;

  const std::uint32_t session_;
  const SceneLimits limits_;
  State state_;
  std::vector<PlacedShape> placed_;
  std::map<Stretched, std::shared_ptr<const Shape>> stretched_;  // those in use
};

struct Followed {
  std::vector<Instance> instances;
  std::int64_t blend_ns = 0;  ///< for the next snapshot
};

/// The instances of the next snapshot, from those of this client in the last one, both by rising key: what was there
/// moves from where it is at `begin_ns` to its new place until `end_ns`; what is new, or all when end_ns <= begin_ns,
/// is there at once. What bends comes over in the same time.
Followed followOn(const std::vector<PlacedShape>& placed, std::span<const Instance* const> last, std::int64_t begin_ns,
                  std::int64_t end_ns);

}  // namespace hl
