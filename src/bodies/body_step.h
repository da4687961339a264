// Body step: moves all bodies of a world by one step of the servo. The hands are nodes of the same solve.
//
//   velocities after gravity -> rows for what touches and for the hands -> impulses -> rows for what would be passed
//   through -> impulses -> bounces -> new poses
//
// A contact that is still open has a row only if the motion found would go through it: a body that slides over a flat
// mesh meets the edges ahead of it, and none of them stops it.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "bodies/hand_node.h"
#include "bodies/meetings.h"
#include "bodies/placed_bodies.h"
#include "bodies/row.h"
#include "bodies/world.h"

namespace hl {

struct BodyStepReport {
  int rows = 0;
  int sweeps = 0;           ///< of the longest solve
  std::size_t dropped = 0;  ///< contacts without room
  double deepest = 0;       ///< m, greatest overlap at the begin of the step, >= 0
};

/// By one thread at a time.
class BodyStepper {
 public:
  explicit BodyStepper(std::shared_ptr<const World> world);
  /// Moves `state` by `period_s` (> 0). `given`: room for each hand's impulses. RT-safe.
  BodyStepReport step(WorldState& state, double period_s, std::span<const HandNode> hands,
                      std::span<GivenImpulses> given);
  const World& world() const { return *world_; }
  /// Of the last step.
  std::span<const Row> rows() const { return rows_; }

 private:
  /// How a pair moves: whether the rows of its begin may miss its end.
  struct Pace {
    bool fast = false, turns = false;
  };
  /// A point of a meeting without a gap.
  struct Touching {
    std::uint32_t meeting = 0, point = 0;
    double gap = 0;
  };
  void begin(const WorldState& state, double period_s, std::span<const HandNode> hands, std::span<GivenImpulses> given);
  void addHandRows(const HandNode& hand, std::size_t number, ContactMemory& memory);
  double marginOf(double period_s) const;
  void addRow(ContactMemory& memory, Meeting& meeting, std::size_t point);
  ContactPair pairOf(const Meeting& meeting) const;
  void recall(Row& row, ContactMemory& memory) const;
  Vec3 placeOf(const Row& row) const;
  void addBearing(ContactMemory& memory);
  bool hasTwin(const Meeting& meeting, std::size_t point) const;
  bool addPassed(WorldState& state, double period_s);
  Pace paceOf(const Meeting& meeting, double period_s) const;
  Row rowOf(const Meeting& meeting, std::size_t point) const;
  void addRowsOfEnd(const Meeting& meeting, const Manifold& end, double period_s);
  bool goesThrough(const Meeting& meeting, std::size_t point, double period_s) const;
  bool meetsAtEnd(const WorldState& state, const Meeting& meeting, double period_s, Manifold& end) const;
  void planMotion(double period_s, double margin);
  void pushApart(double period_s);
  void bounce(double period_s);
  void book(WorldState& state, std::span<const GivenImpulses> owed, double period_s) const;
  void tellHands(std::span<GivenImpulses> given) const;
  void move(WorldState& state, double period_s) const;
  void remember(WorldState& state) const;
  int numberOf(std::uint64_t key) const;

  std::shared_ptr<const World> world_;
  PlacedBodies placed_;
  std::vector<Mat3> turned_;  // of each body at the begin of the step
  Meetings meetings_;
  std::vector<Node> nodes_;   // bodies, then hands
  std::vector<Node> before_;  // their velocities before the step, without gravity
  std::vector<Vec3> ways_;    // m, of the centres
  std::vector<Vec3> turns_;   // rad/s, while they move
  std::vector<Node> apart_;   // velocities that only push overlapping bodies apart
  std::vector<Row> rows_, overlaps_;
  std::vector<Touching> touching_;
  std::size_t hand_rows_ = 0;  // the first of all
};

}  // namespace hl
