#include "proxy/start_search.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

#include "proxy/clear_place.h"
#include "proxy/contacts.h"

namespace hl {

namespace {

using convergence::kAcross, convergence::kBeyond, convergence::kSpheres;

constexpr int kDirections = 6 * kAcross * kAcross;

// In reaches.
double sphereRadius(int sphere) { return std::ldexp(sphere % 2 == 0 ? 1 : M_SQRT2, sphere / 2); }

Vec3 directionOf(int number) {
  const int side = number / (kAcross * kAcross), cell = number % (kAcross * kAcross);
  const auto middle = [](int i) { return (2 * i + 1.0) / kAcross - 1; };
  Vec3 direction;
  direction[side % 3] = side < 3 ? 1 : -1;
  direction[(side + 1) % 3] = middle(cell % kAcross);
  direction[(side + 2) % 3] = middle(cell / kAcross);
  return direction.normalized();
}

// The contact that has exactly `nearer` contacts before it, sorted by distance from the centre and then by the order of
// the set.
const Contact& nearestBut(const ContactSet& set, std::size_t nearer) {
  FixedVector<const Contact*, kMaxContacts> sorted;
  for (const Contact& contact : set.contacts) sorted.push(&contact);
  const auto before = [](const Contact* a, const Contact* b) {
    return a->distance != b->distance ? a->distance < b->distance : a < b;
  };
  std::nth_element(sorted.begin(), sorted.begin() + nearer, sorted.end(), before);
  return *sorted[nearer];
}

// Candidate `number` for the finger, whose contacts are `set`, if there is such a one.
std::optional<Vec3> placeOf(int number, const ContactSet& set, double reach, const Vec3& finger) {
  if (number == 0) return finger;
  if (number <= kBeyond) {
    const auto nearer = static_cast<std::size_t>(number - 1);
    if (nearer >= set.contacts.size()) return std::nullopt;
    const Contact& contact = nearestBut(set, nearer);
    return contact.point - reach * contact.plane.normal;
  }
  const int around = number - 1 - kBeyond;
  return finger + reach * sphereRadius(around / kDirections) * directionOf(around % kDirections);
}

}  // namespace

const int StartSearch::kPlaces = 1 + kBeyond + kSpheres * kDirections;

bool StartSearch::look(const SceneAt& scene, const Tolerances& tolerance, const Vec3& finger, int places,
                       Vec3& position) {
  ContactSet set;
  gatherContacts(scene, finger, tolerance.reach - tolerance.skin, tolerance.reach, set);
  position = finger;
  bool found = set.contacts.empty();
  for (int i = 0; i < places && !found; ++i) {
    const int pushes = next_ == 0 ? convergence::kPushesOfFinger : convergence::kPushesOfPlace;
    std::optional<Vec3> place = placeOf(next_, set, tolerance.reach, finger);
    found = place && findClearPlace(scene, tolerance, pushes, *place);
    if (found) position = *place;
    next_ = (next_ + 1) % kPlaces;
  }
  if (found) next_ = 0;
  return found;
}

}  // namespace hl
