// Pair at end: the two shapes of a meeting after a step, and whether they then overlap.
#pragma once

#include "bodies/body_problem.h"
#include "bodies/end_places.h"
#include "bodies/pair_along.h"

namespace hl {

/// The shapes of a pair after their part of the way, until `ends` has others, and how they lie along the normal of the
/// begin. RT-safe.
struct PairAtEnd {
  PairAtEnd(const BodyProblem& problem, const WorldState& state, const Meeting& meeting, const BodyWays& plan,
            EndPlaces& ends);
  PairAtEnd(const PairAtEnd&) = delete;
  PairAtEnd& operator=(const PairAtEnd&) = delete;

  PlacedRoom room;  // of a primitive of the scene
  const PlacedConvex a, b;
  const PairAlong along;
};

/// Whether the plane of a triangle of the scene has the pair on its two sides at the begin and at the end, though they
/// met beside it: a body that slides over a mesh does not hit the edges of the triangles ahead. RT-safe.
bool isKeptApart(const BodyProblem& problem, const Meeting& meeting, const PairAtEnd& end);

/// m, >= 0: how far the pair would overlap then. `end`: where; without points if it is apart, or has passed through
/// along the normal of the begin. RT-safe.
double overlapOf(const PairAtEnd& pair, Manifold& end);

}  // namespace hl
