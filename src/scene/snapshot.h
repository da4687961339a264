// Snapshot: the immutable scene for contact queries: shapes, each placed as an instance.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "geometry/box_tree.h"
#include "scene/compliance.h"
#include "scene/field_spec.h"
#include "scene/label.h"
#include "scene/material.h"
#include "scene/mechanics.h"
#include "scene/mesh_motion.h"
#include "scene/motion.h"
#include "scene/rigid_body.h"
#include "scene/shape.h"
#include "scene/snap_spec.h"
#include "scene/texture.h"

namespace hl {

/// Surface properties of an instance: the materials to which the material numbers of its shape refer.
struct Surfaces {
  std::vector<Material> materials;                       ///< at least as many as the shape's model has
  std::vector<std::shared_ptr<const Texture>> textures;  ///< indexed by TextureUse::texture
  bool operator==(const Surfaces&) const = default;
};

/// A placed shape.
struct Instance {
  std::shared_ptr<const Shape> shape;
  std::shared_ptr<const Surfaces> surfaces;
  Motion motion;          ///< as given by its client
  std::uint64_t key = 0;  ///< same for the same object in the next snapshot; unique in a snapshot; > 0
  std::uint32_t session = 0, object = 0, name = 0;  ///< client session, object id and name given by the client
  bool plain = false;  ///< all materials are the default, so there are no surface rules; set by makeSnapshot
  std::shared_ptr<const MeshMotion> mesh_motion{};  ///< transitions of a deforming mesh to `shape`; null: none

  /// Moves the instance in place of its client; null: none.
  std::shared_ptr<const PoseSource> driver{};
  std::shared_ptr<const RigidBody> body{};  ///< null: it has no mass. Its poses are the driver, unless it is fixed
  /// How it yields between the frames of a client that deforms it; null: its client has not given it.
  std::shared_ptr<const ComplianceMotion> compliance{};
  bool answers_force = false;                 ///< its client deforms it by the forces that it reads
  std::uint32_t item = 0;                     ///< index of its item in the object, or in the world if `object` is 0
  std::shared_ptr<const SnapList> snaps{};    ///< places that hold the proxy; null: none
  std::shared_ptr<const FieldList> fields{};  ///< forces on the hand from its places; null: none
  /// Number of the snapshot in which its shape took the place of another one at once, wherever the proxy was; 0: never.
  std::uint64_t replaced_in = 0;
  std::shared_ptr<const Label> label{};  ///< for pages; null: its file, or its client, gives it none

  /// Poses of the instance over time. Of a body that moves: for the loop that ticks alone (others: still_scene.h).
  const PoseSource& poses() const { return driver ? *driver : static_cast<const PoseSource&>(motion); }
  bool movesAsBody() const { return body && body->poses; }
  /// Whether it is a body that is not in `region` now, though it may be at another time. As poses().
  bool elsewhere(const Box& region) const { return movesAsBody() && !body->poses->near().meets(region); }
  /// Where to draw it. Any thread.
  Pose shownAt(std::int64_t time_ns) const { return movesAsBody() ? body->poses->shown().pose : poses().at(time_ns); }
  /// Whether it is at rest with its object frame equal to the world frame.
  bool atWorld() const { return !driver && motion.identity(); }
  /// The transition of the mesh at this time, or null if the mesh is `shape`.
  const MeshTransition* transitionAt(std::int64_t time_ns) const {
    return mesh_motion && time_ns < mesh_motion->end_ns() ? &mesh_motion->at(time_ns) : nullptr;
  }
  /// The shape that numbers the primitives and has their surface data at this time.
  const Shape& shapeAt(std::int64_t time_ns) const {
    const MeshTransition* const way = transitionAt(time_ns);
    return way ? *way->to() : *shape;
  }
};

/// A snap of an instance.
struct PlacedSnap {
  std::uint32_t instance = 0, number = 0;  ///< indices in Snapshot::instances and its snaps
};

/// A field of an instance.
struct PlacedField {
  std::uint32_t instance = 0, number = 0;  ///< indices in Snapshot::instances and its fields
};

/// Snapshot::blend_ns when objects appear, disappear or change abruptly. At 1800 N/m and the device's 8.5 N it gives
/// 140 N/s, about the rate at which a person presses.
inline constexpr std::int64_t kAbruptBlend_ns = 60'000'000;

/// A tick asks each of them for the matter around the proxy.
inline constexpr std::size_t kMaxMatter = 16;

/// Immutable after makeSnapshot; read by any thread. Metres, world frame.
struct Snapshot {
  std::vector<Instance> instances;        ///< sorted by key
  std::vector<Box> reach;                 ///< of each instance: bounds during its whole motion, world frame
  BoxTree near;                           ///< finds instances by `reach`
  std::vector<std::uint32_t> moving;      ///< numbers of instances whose pose changes
  std::vector<std::uint32_t> deforming;   ///< numbers of instances whose mesh deforms
  std::vector<std::uint32_t> matter;      ///< numbers of instances that know where their matter is, at most kMaxMatter
  std::vector<std::uint32_t> all_matter;  ///< the same without the limit: asked where a surface has replaced another
  std::vector<PlacedSnap> snaps;          ///< of all instances, as many as may count, in their order
  std::vector<PlacedField> fields;        ///< as `snaps`
  Box bounds;                             ///< of all instances at their final poses
  /// m: largest absolute coordinate, in the world or in an object; distances have an error of a few units in its last
  /// place.
  double extent = 0;
  std::int64_t moves_until_ns = std::numeric_limits<std::int64_t>::min();    ///< from then on everything is at rest
  std::int64_t deforms_until_ns = std::numeric_limits<std::int64_t>::min();  ///< from then on each mesh is its shape
  std::uint64_t number = 1;    ///< increases from snapshot to snapshot of one server
  std::uint64_t identity = 0;  ///< unique among all snapshots of the process
  std::int64_t blend_ns = 0;   ///< of the force transition, if objects changed abruptly since the last one
  std::size_t primitives = 0;  ///< total over all instances
  Mechanics mechanics;         ///< of the instances that are bodies
  std::string name;
  std::vector<std::string> warnings;

  const Shape& shape(std::size_t instance = 0) const { return *instances[instance].shape; }
  /// The number of the instance with this key; false: there is none. RT-safe.
  bool find(std::uint64_t key, std::uint32_t& number) const;
};

/// The surfaces described by the shape's own model.
std::shared_ptr<const Surfaces> surfacesOf(const std::shared_ptr<const Shape>& shape);

/// The instance is this body from now on, at its start.
void setBody(Instance& instance, std::shared_ptr<const RigidBody> body);

/// Instances that move as bodies.
std::size_t movingBodies(const Snapshot& snapshot);

/// Memory of the scene, bytes: each shape and texture counts once, however many instances use it. Allocates.
std::size_t memoryOf(const Snapshot& snapshot);

/// Allocates; never called by a real-time thread.
std::shared_ptr<const Snapshot> makeSnapshot(std::vector<Instance> instances, std::string name = {},
                                             std::uint64_t number = 1, std::int64_t blend_ns = kAbruptBlend_ns,
                                             const Mechanics& mechanics = {});
/// A scene of one model at its own coordinates: world and object frame are the same.
std::shared_ptr<const Snapshot> makeSnapshot(Model model, HierarchyKind hierarchy = HierarchyKind::kBvh);

}  // namespace hl
