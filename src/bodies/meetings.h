// Meetings: the pairs that may touch within a step: parts of bodies with parts of others, and with primitives of the
// fixed scene.
#pragma once

#include <vector>

#include "bodies/joint_groups.h"
#include "bodies/near_primitives.h"
#include "bodies/placed_bodies.h"
#include "scene/scene_at.h"

namespace hl {

struct Meeting {
  int a = 0, b = 0;            ///< numbers of bodies; b is Row::kFixed for the scene
  int part_a = 0, part_b = 0;  ///< of the bodies: Compound::parts
  PrimitiveId primitive{};     ///< of the scene
  Manifold manifold;
  std::uint32_t used = 0;   ///< bit i: point i of the manifold has a row
  std::uint32_t inner = 0;  ///< bit i: others keep point i apart (contact_hull.h)

  bool isInner(std::size_t point) const { return (inner >> point & 1) != 0; }
  bool uses(std::size_t point) const { return (used >> point & 1) != 0; }
};

/// Room for the meetings of a body, and for those of each part beyond its first: with the scene and with others.
inline constexpr std::size_t kMeetingsPerBody = kContactsPerBody, kMeetingsPerPart = 16;

/// By one thread at a time.
class Meetings {
 public:
  explicit Meetings(const World& world);
  /// From now on the scene is as at this time. RT-safe.
  void look(std::int64_t time_ns);
  /// All within `margin` (m). The order depends on keys and places alone. RT-safe: what finds no room is counted.
  void find(const WorldState& state, const PlacedBodies& placed, double margin);
  std::vector<Meeting>& all() { return meetings_; }
  const std::vector<Meeting>& all() const { return meetings_; }
  std::size_t dropped() const { return dropped_; }
  std::size_t room() const { return meetings_.capacity(); }
  /// The scene without bodies, as look() has it; null if there is none.
  const SceneAt* scene() const { return scene_ ? &*scene_ : nullptr; }

 private:
  void withScene(const WorldState& state, const PlacedBodies& placed, double margin);
  PlacedConvex placedOf(PrimitiveId id, PlacedRoom& room) const;
  void partWithScene(Meeting& meeting, const PlacedConvex& part, double margin);
  void withBodies(const WorldState& state, const PlacedBodies& placed, double margin);
  void meet(const WorldState& state, const PlacedBodies& placed, double margin, std::uint32_t one, std::uint32_t other);
  void add(const Meeting& meeting);

  std::vector<Meeting> meetings_;
  NearPrimitives nearest_;
  std::vector<PrimitiveId> near_;  // the same, in order

  std::vector<std::uint32_t> along_x_;
  std::vector<double> reach_, low_x_;  // m
  double widest_ = 0;                  // m, greatest reach
  JoinedPairs joined_;
  std::shared_ptr<const Snapshot> fixed_;
  ManyRecentPrimitives recent_;
  std::optional<SceneAt> scene_;
  std::size_t dropped_ = 0;
};

}  // namespace hl
