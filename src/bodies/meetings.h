// Meetings: the pairs that may touch within a step: parts of bodies with parts of others, and with primitives of the
// fixed scene.
#pragma once

#include <array>
#include <vector>

#include "bodies/joint_groups.h"
#include "bodies/near_primitives.h"
#include "bodies/placed_bodies.h"
#include "bodies/sweep_and_prune.h"
#include "scene/scene_at.h"

namespace hl {

struct Meeting {
  int a = 0, b = 0;            ///< numbers of bodies; b is Row::kFixed for the scene
  int part_a = 0, part_b = 0;  ///< of the bodies: Compound::parts
  PrimitiveId primitive{};     ///< of the scene
  bool beside = false;         ///< what rolls meets a triangle at its rim, nearly along its normal
  Manifold manifold;
  std::uint32_t used = 0;   ///< bit i: point i of the manifold has a row
  std::uint32_t inner = 0;  ///< bit i: others keep point i apart (contact_hull.h)

  bool isInner(std::size_t point) const { return (inner >> point & 1) != 0; }
  bool uses(std::size_t point) const { return (used >> point & 1) != 0; }
};

/// m: how far in a step any point goes at most.
struct MostWays {
  std::vector<double> bodies;    ///< of each; 0 while it sleeps
  std::vector<double> to_scene;  ///< of each; as far as the scene is looked at
  double scenery = 0;
};

/// Cosine of the angle by which a normal may differ from that of a triangle, and the two meet nearly along it.
inline constexpr double kSameWay = 0.9;

/// Whether that is the normal of a triangle's face. RT-safe.
bool isByFace(const PlacedConvex& primitive, const Vec3& normal);

/// Room for the meetings of a body, and for those of each part beyond its first: with the scene and with others.
inline constexpr std::size_t kMeetingsPerBody = kContactsPerBody, kMeetingsPerPart = 16;

/// By one thread at a time.
class Meetings {
 public:
  explicit Meetings(const World& world);
  /// From now on the scene is as at this time. RT-safe.
  void look(std::int64_t time_ns);
  /// All that may touch after they have gone these ways. The order depends on keys and places alone. RT-safe: what
  /// finds no room is counted.
  void find(const WorldState& state, const PlacedBodies& placed, const SweepAndPrune& near, const MostWays& ways);
  std::vector<Meeting>& all() { return meetings_; }
  const std::vector<Meeting>& all() const { return meetings_; }
  std::size_t dropped() const { return dropped_; }
  std::size_t room() const { return meetings_.capacity(); }
  /// The scene without bodies, as look() has it; null if there is none.
  const SceneAt* scene() const { return scene_ ? &*scene_ : nullptr; }

 private:
  void withScene(const WorldState& state, const PlacedBodies& placed, const MostWays& ways);
  PlacedConvex placedOf(PrimitiveId id, PlacedRoom& room) const;
  void partWithScene(Meeting& meeting, const PlacedConvex& part, double margin);
  void withBodies(const WorldState& state, const PlacedBodies& placed, const SweepAndPrune& near, const MostWays& ways);
  void meet(const PlacedBodies& placed, double margin, std::uint32_t a, std::uint32_t b);
  void add(const Meeting& meeting);
  void sortFrom(std::size_t first);

  std::vector<Meeting> meetings_;
  NearPrimitives nearest_;
  std::vector<PrimitiveId> near_;  // the same, in order
  // Of a meeting: its pair of bodies and of parts, and where it is to be found.
  std::vector<std::array<int, 5>> order_;

  JoinedPairs joined_;
  std::shared_ptr<const Snapshot> fixed_;
  ManyRecentPrimitives recent_;
  std::optional<SceneAt> scene_;
  std::size_t dropped_ = 0;
};

}  // namespace hl
