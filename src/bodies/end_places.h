// End places: the shapes of bodies after their part of the way in a step. They are made once for a way: each body has
// many pairs, and few bodies get another way from one look at them to the next.
#pragma once

#include <span>
#include <vector>

#include "bodies/placed_bodies.h"

namespace hl {

struct BodyProblem;
struct BodyWays;

/// By one thread at a time.
class EndPlaces {
 public:
  explicit EndPlaces(const World& world);
  /// The parts of a body; until it is asked for with another way. RT-safe.
  std::span<const PlacedConvex> of(const BodyProblem& problem, const WorldState& state, std::size_t body,
                                   const BodyWays& plan);

 private:
  /// From where a body goes, how, and for how long it turns.
  struct Course {
    Vec3 centre, way, turn;
    Eigen::Quaterniond turned;
    double part = 0, period_s = 0;

    bool operator==(const Course& other) const {
      return centre == other.centre && way == other.way && turn == other.turn &&
             turned.coeffs() == other.turned.coeffs() && part == other.part && period_s == other.period_s;
    }
  };

  std::vector<Course> courses_;  // of each body
  PlacedBodies placed_;
};

}  // namespace hl
