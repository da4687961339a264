// Snapshot: the immutable scene that the proxy touches: shapes, each placed where an object is.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "geometry/box_tree.h"
#include "scene/material.h"
#include "scene/mesh_motion.h"
#include "scene/motion.h"
#include "scene/shape.h"
#include "scene/texture.h"

namespace hl {

/// How the surfaces of an instance feel: what the material numbers of its shape mean here.
struct Surfaces {
  std::vector<Material> materials;                       ///< at least as many as the shape's model has
  std::vector<std::shared_ptr<const Texture>> textures;  ///< what TextureUse::texture counts
  bool operator==(const Surfaces&) const = default;
};

/// A shape where it is shown.
struct Instance {
  std::shared_ptr<const Shape> shape;
  std::shared_ptr<const Surfaces> surfaces;
  Motion motion;          ///< as its client shows it
  std::uint64_t key = 0;  ///< the same object in the next snapshot has the same one; unique in a snapshot
  std::uint32_t session = 0, object = 0, name = 0;  ///< whose it is and what its client calls it
  bool plain = false;  ///< no surface of it does more than hold off: all materials are the default; by makeSnapshot
  std::shared_ptr<const MeshMotion> mesh_motion{};  ///< how the mesh gets to `shape`, where it does not stay as it is

  /// Who moves it in place of its client; null: nobody.
  std::shared_ptr<const PoseSource> driver{};

  /// Where it is.
  const PoseSource& poses() const { return driver ? *driver : static_cast<const PoseSource&>(motion); }
  /// Whether it is at rest where its frame and the world's are one.
  bool atWorld() const { return !driver && motion.identity(); }
  /// How its mesh moves at this moment; null where it is `shape`.
  const MeshTransition* transitionAt(std::int64_t time_ns) const {
    return mesh_motion && time_ns < mesh_motion->end_ns() ? &mesh_motion->at(time_ns) : nullptr;
  }
  /// What numbers its primitives and says of their surfaces at this moment.
  const Shape& shapeAt(std::int64_t time_ns) const {
    const MeshTransition* const way = transitionAt(time_ns);
    return way ? *way->to() : *shape;
  }
};

/// Snapshot::blend_ns where objects come, go or change at once. At 1800 N/m and the device's 8.5 N that is 140 N/s, as
/// when a person presses.
inline constexpr std::int64_t kAbruptBlend_ns = 60'000'000;

/// Immutable after makeSnapshot; read by any thread. Metres, world frame.
struct Snapshot {
  std::vector<Instance> instances;       ///< by rising key
  std::vector<Box> reach;                ///< of each instance: all of it during the whole motion, world
  BoxTree near;                          ///< finds instances by their reach
  std::vector<std::uint32_t> deforming;  ///< instances whose mesh moves
  Box bounds;                            ///< of all of them where they come to rest
  /// m: largest coordinate, in the world or in an object; distances are known to a few units in its last place.
  double extent = 0;
  std::int64_t moves_until_ns = std::numeric_limits<std::int64_t>::min();    ///< after that all is at rest
  std::int64_t deforms_until_ns = std::numeric_limits<std::int64_t>::min();  ///< and after that each mesh is its shape
  std::uint64_t number = 1;                                                  ///< of one server's snapshots, rising
  std::uint64_t identity = 0;  ///< no other snapshot made in this program has the same one
  std::int64_t blend_ns = 0;   ///< how long the hand is to take from what the one before had in other places
  std::size_t primitives = 0;  ///< each instance counted
  std::string name;
  std::vector<std::string> warnings;

  const Shape& shape(std::size_t instance = 0) const { return *instances[instance].shape; }
};

/// The surfaces as the shape's own model describes them.
std::shared_ptr<const Surfaces> surfacesOf(const std::shared_ptr<const Shape>& shape);

/// Bytes that the scene keeps: each shape and texture once, however many instances show it. Allocates.
std::size_t memoryOf(const Snapshot& snapshot);

/// Allocates; never called by a real-time thread.
std::shared_ptr<const Snapshot> makeSnapshot(std::vector<Instance> instances, std::string name = {},
                                             std::uint64_t number = 1, std::int64_t blend_ns = kAbruptBlend_ns);
/// One model where it says, world and object frame the same.
std::shared_ptr<const Snapshot> makeSnapshot(Model model, HierarchyKind hierarchy = HierarchyKind::kBvh);

}  // namespace hl
