#include "proxy/bend.h"

#include <algorithm>
#include <array>
#include <cstdint>

#include "geometry/queries.h"
#include "proxy/carry.h"
#include "proxy/clear_place.h"
#include "proxy/tolerances.h"

namespace hl {

namespace {

// Of the radius: what the proxy touched lies within.
constexpr double kTouching = 1.1;

// A primitive of a mesh before it was bent, and its place nearest to the proxy.
struct Nearest {
  std::uint32_t primitive = 0;
  ClosestPoint place;
};

// Looks farther until there is something, as mostly there is at once; by little, as of a fine mesh much is a little
// farther than the nearest. False where there is nothing within `most`.
bool nearestTo(const Shape& shape, const Vec3& p, double least, double most, Nearest& out) {
  constexpr double kFarther = 1.1;
  bool found = false;
  for (double within = std::min(least, most); !found; within = std::min(most, kFarther * within)) {
    primitivesWithin(*shape.index, shape.primitives, p, within,
                     [&](std::uint32_t primitive, const ClosestPoint& place) {
                       if (found && place.distance >= out.place.distance) return;
                       found = true;
                       out = {primitive, place};
                     });
    if (within >= most) break;
  }
  return found;
}

// The number in the mesh of a primitive's vertex, counted in sorted order.
std::uint32_t vertexOf(const Model& model, const Primitive& primitive, std::size_t sorted) {
  switch (primitive.kind) {
    case PrimitiveKind::kTriangle:
      return model.triangles[primitive.source][primitive.order[sorted]];
    case PrimitiveKind::kSegment:
      return model.segments[primitive.source][std::min<std::size_t>(1, primitive.order[sorted])];
    case PrimitiveKind::kPoint:
      break;
  }
  return model.points[primitive.source];
}

class Bend {
 public:
  Bend(ProxyState& state, const Snapshot& snapshot, const ProxySettings& settings)
      : state_(state), snapshot_(snapshot), tolerance_(Tolerances::of(settings.radius, snapshot.extent)) {}

  void run() {
    for (const std::uint32_t i : snapshot_.bent) push(i);
  }

 private:
  Vec3 besideIt(const Instance& instance, const Nearest& nearest, const Vec3& p) const;
  double freeOfOthers(std::uint32_t but, const Vec3& to) const;
  void push(std::uint32_t i);

  ProxyState& state_;
  const Snapshot& snapshot_;
  const Tolerances tolerance_;
};

// Where the place nearest to the proxy at p has gone, and the proxy as far from there: above a face, which may have
// turned, on the same side of it; a face that has shrunk to nothing has no sides, so only moves it. Frame of the
// object.
Vec3 Bend::besideIt(const Instance& instance, const Nearest& nearest, const Vec3& p) const {
  const Shape& before = *instance.before;
  const Primitive was = before.primitives[nearest.primitive];
  const ClosestPoint& place = nearest.place;
  std::array<Vec3, 3> now;  // in sorted order
  Vec3 point = Vec3::Zero();
  for (std::size_t i = 0; i < 3; ++i) {
    now[i] = instance.shape->model.positions[vertexOf(before.model, was, i)];
    point += place.weights[i] * now[i];
  }
  if (place.feature != Feature::kFace || !isTriangle(now[0], now[1], now[2])) return p + (point - place.point);
  const auto normalOf = [](const std::array<Vec3, 3>& v) { return (v[1] - v[0]).cross(v[2] - v[0]); };
  const double side = normalOf(was.vertex).dot(place.normal) < 0 ? -1 : 1;
  return point + side * place.distance * normalOf(now).normalized();
}

// How far the way of the proxy to there is free of all objects but one, as a part of it.
double Bend::freeOfOthers(std::uint32_t but, const Vec3& to) const {
  double part = 1;
  const Vec3 margin = Vec3::Constant((to - state_.position).norm() + tolerance_.reach);
  snapshot_.near.visitMet({state_.position - margin, state_.position + margin}, [&](std::uint32_t i) {
    if (i == but) return;
    const Instance& instance = snapshot_.instances[i];
    const Pose pose = instance.motion.at(state_.time_ns);
    const Vec3 from = pose.toObject(state_.position);
    FirstImpact hit;
    if (firstImpact(*instance.shape->index, instance.shape->primitives, from, pose.toObject(to) - from,
                    kMetAt * tolerance_.reach, -1, hit))
      part = std::min(part, hit.impact.t);
  });
  return part;
}

// The friction of what it touches takes the proxy along, as far as others let it. Else, as seen from the mesh, the
// proxy goes from where it was beside it to where it is.
void Bend::push(std::uint32_t i) {
  const Instance& instance = snapshot_.instances[i];
  const Shape& shape = *instance.shape;
  const Pose pose = instance.motion.at(state_.time_ns);
  const Vec3 p = pose.toObject(state_.position);
  const double farthest = tolerance_.reach + std::min(instance.bent_m, kMostBendRadii * tolerance_.reach);
  Nearest nearest;
  if (!nearestTo(*instance.before, p, kTouching * tolerance_.reach, farthest, nearest)) return;
  Vec3 from_W = pose.toWorld(besideIt(instance, nearest, p));
  if (!withinReach(from_W)) return;
  findClearPlace({snapshot_, state_.time_ns}, tolerance_, kPushTries, from_W);  // what is around it may lie otherwise
  const bool held = instance.key == state_.carrier && nearest.place.distance <= kTouching * tolerance_.reach;
  if (held && freeOfOthers(i, from_W) == 1) {
    state_.position = from_W;
    return;
  }
  const Vec3 from = pose.toObject(from_W);
  FirstImpact hit;
  if (!firstImpact(*shape.index, shape.primitives, from, p - from, kMetAt * tolerance_.reach, -1, hit)) return;
  const Vec3 to = pose.toWorld(from + hit.impact.t * (p - from));
  state_.position += freeOfOthers(i, to) * (to - state_.position);
  findClearPlace({snapshot_, state_.time_ns}, tolerance_, kPushTries, state_.position);
}

}  // namespace

void bend(ProxyState& state, const SceneAt& scene, const ProxySettings& settings) {
  const Snapshot& snapshot = scene.snapshot();
  if (!snapshot.bent.empty() && state.snapshot + 1 == snapshot.number) Bend(state, snapshot, settings).run();
}

}  // namespace hl
