// Scene limits: what the scene of one client may have, and the memory in bytes that its parts are counted as before
// they are made. Any thread; a ModelSizes has one owner.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "scene/body_spec.h"
#include "scene/joint_spec.h"
#include "scene/model.h"

namespace hl {

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

/// Memory that a shared pointer takes beside its object: the control block, with the overhead of malloc().
inline constexpr std::size_t kPointer_bytes = 96;
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

}  // namespace hl
