// Contact rows: which contacts of a step have a row: those that bore load in the last step, and those that the motion
// found would go through. So a body that slides over a flat mesh meets the edges ahead of it, and none of them stops
// it.
#pragma once

#include "bodies/body_problem.h"
#include "bodies/contact_hull.h"
#include "bodies/end_places.h"

namespace hl {

/// By one thread at a time.
class ContactRows {
 public:
  explicit ContactRows(BodyProblem& problem);

  /// Rows for what bore load in the last step, and has not come off since. RT-safe.
  void addBearing(ContactMemory& memory);
  /// Rows for what the velocities found would pass through in this step. Those that are rough say where a pair comes
  /// into touch, but not how it would end. False: nothing. RT-safe.
  bool addPassed(WorldState& state, Accuracy accuracy);
  /// What the row begins with: the impulses that acted at its place in the last step. RT-safe.
  void recall(Row& row, ContactMemory& memory) const;
  /// The impulses of this step, for the next. RT-safe.
  void remember(ContactMemory& memory) const;

 private:
  /// A point of a meeting without a gap.
  struct Touching {
    std::uint32_t meeting = 0, point = 0;
    double gap = 0;
  };

  void findTouching();
  void markInner();
  void markInnerOfPlane(std::size_t first, std::size_t end);
  bool isOfPlane(const Touching& one, const Touching& other) const;
  Row rowOf(const Meeting& meeting, std::size_t point) const;
  /// False: there is no room for it.
  bool addRow(ContactMemory& memory, Meeting& meeting, std::size_t point);
  void addRowsOfEnd(const Meeting& meeting, const Manifold& end);
  /// Among the rows from number `first` on.
  bool hasTwin(const Meeting& meeting, std::size_t point, std::size_t first) const;
  bool goesThrough(const Meeting& meeting, std::size_t point) const;
  void addOfMeeting(WorldState& state, Meeting& meeting, Accuracy accuracy);
  /// Whether the meeting's pair has one of the rows from `first` to `end`.
  bool hasRow(const Meeting& meeting, std::size_t first, std::size_t end) const;
  Vec3 placeOf(const Row& row) const;

  BodyProblem& problem_;
  BodyWays plan_;  // as the velocities found would have it
  EndPlaces ends_;
  std::vector<Touching> touching_;
  std::vector<FlatContact> flat_;  // those of them that lie in one plane
};

}  // namespace hl
