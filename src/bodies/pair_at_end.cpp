#include "bodies/pair_at_end.h"

#include <algorithm>

namespace hl {

namespace {

struct PartOfBody {
  int body = 0, part = 0;
};

PlacedConvex partAtEnd(const BodyProblem& problem, const WorldState& state, const PartOfBody& of, const BodyWays& plan,
                       EndPlaces& ends) {
  return ends.of(problem, state, static_cast<std::size_t>(of.body), plan)[static_cast<std::size_t>(of.part)];
}

PlacedConvex primitiveAtEnd(const BodyProblem& problem, PrimitiveId primitive, PlacedRoom& room) {
  const SceneAt& scene = *problem.meetings.scene();
  return placed(scene.primitive(primitive), scene.instance(primitive).poses().at(problem.times.end_ns), room);
}

}  // namespace

PairAtEnd::PairAtEnd(const BodyProblem& problem, const WorldState& state, const Meeting& meeting, const BodyWays& plan,
                     EndPlaces& ends)
    : a(partAtEnd(problem, state, {meeting.a, meeting.part_a}, plan, ends)),
      b(meeting.b == Row::kFixed ? primitiveAtEnd(problem, meeting.primitive, room)
                                 : partAtEnd(problem, state, {meeting.b, meeting.part_b}, plan, ends)),
      along(pairAlong(a, b, meeting.manifold.normal)) {}

// A plane that has two convex shapes on its sides at both ends of a straight motion has them there all the way. Beside
// a triangle a body rolls on the next one, or over an edge: the plane must keep it as well as a contact would. A
// cylinder's points are given roughly beside a rim, its height above a plane exactly.
bool isKeptApart(const BodyProblem& problem, const Meeting& meeting, const PairAtEnd& end) {
  if (meeting.b != Row::kFixed || end.b.vertices.size() != 3) return false;
  const PlacedConvex& a = problem.placed[static_cast<std::size_t>(meeting.a)][static_cast<std::size_t>(meeting.part_a)];
  const Vec3& corner = end.b.vertices[0];
  Vec3 normal = (end.b.vertices[1] - corner).cross(end.b.vertices[2] - corner).normalized();
  if (normal.dot(a.centre - corner) < 0) normal = -normal;
  const bool is_plane = normal.squaredNorm() > 0;
  const double same = normal.dot(meeting.manifold.normal);
  const bool by_face = same >= kSameWay && !meeting.beside;
  if (!is_plane || (by_face && !isRound(end.a))) return false;
  const SceneAt& scene = *problem.meetings.scene();
  PlacedRoom room;
  const PlacedConvex b = placed(scene.primitive(meeting.primitive),
                                scene.instance(meeting.primitive).poses().at(problem.times.begin_ns), room);
  const double least = by_face ? -kTouching_m : meeting.beside ? -kHeld_m : -leftOf(a, b);
  return pairAlong(a, b, normal).gap >= least && pairAlong(end.a, end.b, normal).gap >= least;
}

double overlapOf(const PairAtEnd& pair, Manifold& end) {
  end.points.clear();
  if (pair.along.hasPassed() || pair.along.gap >= 0) return std::max(-pair.along.gap, 0.0);
  return findManifold(pair.a, pair.b, 0, end) ? deepestOf(end) : 0;
}

}  // namespace hl
