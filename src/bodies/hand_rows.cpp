#include "bodies/hand_rows.h"

#include <algorithm>
#include <tuple>

#include "bodies/nearest_points.h"

namespace hl {

namespace {

// rad: near contacts with nearly the normal of another row of the hand are not looked at.
constexpr double kSameNormal = 0.1;
// Of the scene, no more than these: the nearest.
constexpr std::size_t kMaxNear = 16;
static_assert(kMaxNear < kNearOfHand);

}  // namespace

void HandRows::add(const HandNode& hand, std::size_t number, ContactMemory& memory) {
  const auto node = static_cast<int>(problem_.bodies() + number);
  const std::uint64_t name = ~std::uint64_t{number};
  for (const HandContact& contact : hand.contacts) addHeld(contact, node, name, memory);
  if (!(hand.radius_m > 0)) return;
  const std::size_t before = problem_.rows.size();
  most_ = before + kNearOfHand;
  const double margin = addNearBodies(hand, node, name, memory);
  const bool meets_bodies = problem_.rows.size() > before ||
                            std::any_of(hand.contacts.begin(), hand.contacts.end(), [&](const HandContact& contact) {
                              return problem_.numberOf(contact.key) != Row::kFixed;
                            });
  if (meets_bodies && problem_.meetings.scene() != nullptr) addNearScene(hand, node, name, margin, memory);
}

void HandRows::addHeld(const HandContact& contact, int node, std::uint64_t name, ContactMemory& memory) {
  if (!problem_.hasRoom()) return;
  Row row;
  row.pair = {name, contact.key};
  row.a = node;
  row.b = contact.key == 0 ? Row::kFixed : problem_.numberOf(contact.key);
  row.normal = contact.normal;
  if (row.b != Row::kFixed) row.arm_b = contact.point - problem_.nodes[static_cast<std::size_t>(row.b)].centre;
  row.static_friction = contact.static_friction;
  row.dynamic_friction = contact.dynamic_friction;
  contacts_.recall(row, memory);
  row.friction = contact.slipping ? row.dynamic_friction : row.static_friction;
  problem_.rows.push_back(row);
}

// A body takes the proxy along as far as it goes itself. Returns how far (m) the scene may be that stops the proxy
// then.
double HandRows::addNearBodies(const HandNode& hand, int node, std::uint64_t name, ContactMemory& memory) {
  const double own = hand.stretch.norm();
  double farthest = own;
  for (std::size_t i = 0; i < problem_.bodies(); ++i) {
    const double margin = own + 2 * bounds_.ways().bodies[i];
    const double near = problem_.reachOf(i) + hand.radius_m + margin;
    if ((problem_.nodes[i].centre - hand.proxy).squaredNorm() > near * near) continue;
    farthest = std::max(farthest, margin);
    Row row;
    row.pair = {name, problem_.world->bodies[i].key};
    row.a = node;
    row.b = static_cast<int>(i);
    for (const PlacedConvex& part : problem_.placed[i]) addNearPart(hand, row, part, margin, memory);
  }
  return farthest;
}

// One row a part: along the line between the nearest points.
void HandRows::addNearPart(const HandNode& hand, Row row, const PlacedConvex& part, double margin,
                           ContactMemory& memory) {
  const NearestPoints nearest = nearestToPoint(hand.proxy, part);
  row.gap = nearest.distance - part.shape->radius - hand.radius_m;
  if (row.gap > margin) return;
  row.normal = nearest.normal;
  const Vec3& centre = problem_.nodes[static_cast<std::size_t>(row.b)].centre;
  row.arm_b = nearest.on_b + part.shape->radius * nearest.normal - centre;
  addNear(row, memory);
}

void HandRows::addNearScene(const HandNode& hand, int node, std::uint64_t name, double margin, ContactMemory& memory) {
  const SceneAt& scene = *problem_.meetings.scene();
  const auto nearer = [](const ClosestPoint& x, const ClosestPoint& y) {
    return std::tuple(x.distance, x.normal.x(), x.normal.y(), x.normal.z()) <
           std::tuple(y.distance, y.normal.x(), y.normal.y(), y.normal.z());
  };
  FixedVector<ClosestPoint, kMaxNear> near;  // a heap: the farthest first
  scene.primitivesWithin(hand.proxy, hand.radius_m + margin, [&](PrimitiveId, const ClosestPoint& point) {
    if (near.size() == kMaxNear) {
      if (!nearer(point, near[0])) return;
      std::pop_heap(near.begin(), near.end(), nearer);
      near.resize(kMaxNear - 1);
    }
    near.push(point);
    std::push_heap(near.begin(), near.end(), nearer);
  });
  std::sort(near.begin(), near.end(), nearer);
  for (const ClosestPoint& point : near) {
    Row row;
    row.pair = {name, 0};
    row.a = node;
    row.normal = point.normal;
    row.gap = point.distance - hand.radius_m;
    addNear(row, memory);
  }
}

void HandRows::addNear(Row row, ContactMemory& memory) {
  const bool known = std::any_of(problem_.rows.begin(), problem_.rows.end(), [&](const Row& other) {
    return other.a == row.a && other.b == row.b &&
           (other.normal - row.normal).squaredNorm() < kSameNormal * kSameNormal;
  });
  if (known || !problem_.hasRoom(most_)) return;
  contacts_.recall(row, memory);
  problem_.rows.push_back(row);
}

}  // namespace hl
