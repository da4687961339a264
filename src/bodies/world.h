// World: the rigid bodies of a scene, and their state, which a step changes (body_step.h).
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "bodies/compound.h"
#include "bodies/contact_memory.h"
#include "bodies/energy_book.h"
#include "bodies/joint.h"
#include "bodies/mass.h"
#include "scene/body_spec.h"
#include "scene/pose.h"
#include "scene/snapshot.h"

namespace hl {

struct Body {
  std::uint64_t key = 0;  ///< as Instance::key; unique in a world; > 0
  Mass mass{};
  Compound shape;
  BodySurface surface{};
  double hull_error_m = 0;     ///< how far the mesh is outside of its shape (convex_hull.h, mesh_parts.h)
  double excess_m = 0;         ///< how far a part of it reaches beyond the mesh (mesh_parts.h)
  std::size_t open_edges = 0;  ///< of its mesh, if it is of parts (mesh_parts.h); 0: it is closed
  double shell_m = 0;          ///< how thick an open mesh counts for the mass; 0: as a solid
};

/// Immutable while it is stepped.
struct World {
  static constexpr std::size_t kNoBody = std::numeric_limits<std::size_t>::max();

  std::vector<Body> bodies;                    ///< sorted by key
  std::vector<Joint> joints;                   ///< sorted by key
  std::shared_ptr<const Snapshot> fixed;       ///< what bodies stand on; null: nothing
  std::optional<BodySurface> fixed_surface{};  ///< of all of `fixed`; absent: as that of the body that touches it
  /// Of single instances of `fixed`, in its place. May be shorter than the list of instances.
  std::vector<std::optional<BodySurface>> fixed_surfaces{};
  Vec3 gravity_m_s2 = Vec3(0, -9.81, 0);

  /// Of an instance of `fixed`, where something of this surface touches it. RT-safe.
  const BodySurface& surfaceOfFixed(std::size_t instance, const BodySurface& touched_by) const {
    if (instance < fixed_surfaces.size() && fixed_surfaces[instance]) return *fixed_surfaces[instance];
    return fixed_surface ? *fixed_surface : touched_by;
  }
  /// Of the body in `bodies`; kNoBody: there is no such body. RT-safe.
  std::size_t numberOf(std::uint64_t key) const {
    const auto at = std::lower_bound(bodies.begin(), bodies.end(), key,
                                     [](const Body& body, std::uint64_t k) { return body.key < k; });
    return at != bodies.end() && at->key == key ? static_cast<std::size_t>(at - bodies.begin()) : kNoBody;
  }
  bool has(std::uint64_t key) const { return numberOf(key) != kNoBody; }
};

/// A step has no more contacts: of each hand those that hold it and those that it may meet (hand_rows.h), and 64 for
/// each of the bodies, whatever its parts; the rest is dropped, and counted.
inline constexpr std::size_t kMaxHands = 8, kContactsOfHand = 8, kNearOfHand = 48, kContactsPerBody = 64;
inline std::size_t mostRows(std::size_t bodies) {
  return kMaxHands * (kContactsOfHand + kNearOfHand) + kContactsPerBody * bodies;
}
inline std::size_t mostRows(const World& world) { return mostRows(world.bodies.size()); }

/// No body is faster at the begin of a step: what is in its way would not be met any more.
inline constexpr double kFastest_m_s = 1000, kFastest_rad_s = 100'000;

/// World frame.
struct BodyState {
  Vec3 centre = Vec3::Zero();  ///< m, of mass
  Eigen::Quaterniond turned = Eigen::Quaterniond::Identity();
  Vec3 velocity = Vec3::Zero();  ///< m/s, of the centre
  Vec3 spin = Vec3::Zero();      ///< rad/s
  int stopped_short = 0;         ///< consecutive steps that went a part of their way only (motion_plan.h)
  double still_s = 0;            ///< how long it has been slow, and no hand has touched it (sleep.h)
  std::uint64_t island = 0;      ///< asleep: lowest key of those that sleep with it; 0: awake
};

/// Plain values but for the lists, whose room is made by startWorld().
struct WorldState {
  std::vector<BodyState> bodies;   ///< as World::bodies
  std::vector<JointState> joints;  ///< as World::joints
  ContactMemory memory;
  ContactMemory asleep;              ///< contacts of what sleeps
  Vec3 gravity_m_s2 = Vec3::Zero();  ///< of the last step: what sleeps wakes if it changes
  EnergyBook energy{};
  std::uint64_t steps = 0;
};

/// Throws Error for joints that cannot be stepped (joint_check.h).
void checkWorld(const World& world);
/// Each body at a pose of its object frame, at rest. `poses`: as World::bodies. Checks the world. Allocates.
WorldState startWorld(const World& world, const std::vector<Pose>& poses);
/// The pose of the object frame. RT-safe.
Pose poseOf(const Body& body, const BodyState& state);
/// Inverse of the inertia about the centre of mass, world frame, 1/(kg m^2). RT-safe.
Mat3 inverseInertia(const Body& body, const BodyState& state);
Mat3 inertiaOf(const Body& body, const BodyState& state);
/// Joules. RT-safe.
double kineticEnergy_J(const Body& body, const BodyState& state);
double kineticEnergy_J(const World& world, const WorldState& state);
double gravityEnergy_J(const World& world, const WorldState& state);
/// Of the springs and force tables of joints.
double springEnergy_J(const World& world, const WorldState& state);

}  // namespace hl
