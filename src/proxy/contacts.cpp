#include "proxy/contacts.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include "proxy/surface.h"
#include "scene/felt_order.h"

namespace hl {

namespace {

auto key(const Contact& c) {
  return std::tuple(c.plane.normal.x(), c.plane.normal.y(), c.plane.normal.z(), c.plane.offset, c.point.x(),
                    c.point.y(), c.point.z());
}

void clear(ContactSet& set) {
  set.contacts.clear();
  set.planes.clear();
  set.twins.clear();
  set.crowd = set.twins_lost = false;
}

// Order of the contacts of a crowd: first the planes that the motion `toward` enters most, then the nearest.
struct Stays {
  Vec3 toward;

  bool operator()(const Contact& a, const Contact& b) const {
    const double into_a = a.plane.normal.dot(toward), into_b = b.plane.normal.dot(toward);
    if (into_a != into_b) return into_a < into_b;
    return a.distance != b.distance ? a.distance < b.distance : key(a) < key(b);
  }
};

// The contacts of a crowd are a heap. Its first element is the next to be dropped.
void addToCrowd(const Contact& contact, const Vec3& toward, ContactSet& set) {
  const Stays stays{toward};
  if (!set.crowd) std::make_heap(set.contacts.begin(), set.contacts.end(), stays);
  set.crowd = true;
  if (!stays(contact, set.contacts[0])) return;
  std::pop_heap(set.contacts.begin(), set.contacts.end(), stays);
  set.contacts[kMaxContacts - 1] = contact;
  std::push_heap(set.contacts.begin(), set.contacts.end(), stays);
}

bool areCopies(const SceneAt& scene, PrimitiveId a, PrimitiveId b) {
  Primitive p = scene.primitive(a), q = scene.primitive(b);
  toOneFrame(scene.instance(a), scene.instance(b), scene.time_ns(), p, q);
  return areCopies(p, q);
}

// Whether `a` is the contact and `b` its twin. Most twins share an edge and are no copies, which the weights of their
// points show: of copies in one object they are the same.
bool comesFirst(const SceneAt& scene, const MaterialOverride& surfaces, const Contact& a, const Contact& b) {
  const auto textured = [&](const Contact& contact) {
    return mayBeTextured(scene, surfaces, contact.primitive, Quantity::kStiffness);
  };
  const bool may_be_copies = a.primitive.instance != b.primitive.instance || a.weights == b.weights;
  if (may_be_copies && (textured(a) || textured(b)) && areCopies(scene, a.primitive, b.primitive)) {
    const auto stiffness = [&](const Contact& contact) {
      return Surface(scene, surfaces, contact.primitive).stiffness(contact.weights);
    };
    const double stiffness_a = stiffness(a), stiffness_b = stiffness(b);
    if (stiffness_a != stiffness_b) return stiffness_a > stiffness_b;
  }
  return scene.precedes(a.primitive, b.primitive);
}

// What a search is for, whatever it finds.
struct Gathering {
  const SceneAt& scene;
  const MaterialOverride& surfaces;
  Vec3 toward;
  double reach;
};

void add(const Gathering& by, PrimitiveId primitive, const ClosestPoint& nearest, ContactSet& set) {
  Contact contact{{nearest.normal, by.reach - nearest.distance},
                  nearest.point,
                  nearest.distance,
                  nearest.feature,
                  primitive,
                  nearest.weights};
  const auto same = [&](const Contact& other) { return samePlane(contact, other); };
  auto* twin = std::find_if(set.contacts.begin(), set.contacts.end(), same);
  if (twin == set.contacts.end()) {
    if (!set.contacts.push(contact)) addToCrowd(contact, by.toward, set);
    return;
  }
  if (twin->primitive == primitive) return;  // the index may offer a primitive twice
  if (comesFirst(by.scene, by.surfaces, contact, *twin)) std::swap(*twin, contact);
  if (!set.twins.push(contact)) set.twins_lost = true;
}

void sort(ContactSet& set) {
  if (set.crowd || set.twins_lost) set.twins.clear();
  std::sort(set.contacts.begin(), set.contacts.end(),
            [](const Contact& a, const Contact& b) { return key(a) < key(b); });
  for (const Contact& contact : set.contacts) set.planes.push(contact.plane);
}

}  // namespace

void gatherContacts(const SceneAt& scene, const Vec3& centre, double distance, double reach, ContactSet& set) {
  const MaterialOverride none;
  const Gathering by{scene, none, Vec3::Zero(), reach};
  clear(set);
  scene.primitivesWithin(centre, distance,
                         [&](PrimitiveId primitive, const ClosestPoint& nearest) { add(by, primitive, nearest, set); });
  sort(set);
}

void gatherContacts(const SceneAt& scene, const Vec3& centre, const Vec3& toward, double distance, double reach,
                    SweepCache& nearby, ContactSet& set, const MaterialOverride& surfaces) {
  const Gathering by{scene, surfaces, toward, reach};
  clear(set);
  if (!nearby.covers(scene, centre, distance)) {
    nearby.begin(scene, distance);
    nearby.beginMeasured(centre, distance);
    scene.primitivesWithin(centre, distance, [&](PrimitiveId primitive, const ClosestPoint& nearest) {
      nearby.add(primitive);
      nearby.addMeasured(primitive, nearest);
      add(by, primitive, nearest, set);
    });
    nearby.endAt(centre);
  } else if (nearby.hasMeasured(centre, distance)) {
    for (const auto& [primitive, nearest] : nearby.measured()) add(by, primitive, nearest, set);
  } else {
    const double skin = distance - reach;  // larger than any rounding error
    nearby.beginMeasured(centre, distance);
    nearby.forEach(centre, centre, distance + skin, [&](PrimitiveId primitive) {
      ClosestPoint nearest;
      if (!scene.closestWithin(primitive, centre, distance + skin, nearest) || nearest.distance > distance) return;
      nearby.addMeasured(primitive, nearest);
      add(by, primitive, nearest, set);
    });
  }
  sort(set);
}

bool primitivesOf(const ContactSet& set, FixedVector<PrimitiveId, cost::kKnownRoom>& primitives) {
  static_assert(cost::kKnownRoom < kMaxContacts, "so that a set with contacts or twins left out has too many");
  bool all = true;
  for (const Contact& contact : set.contacts) all = all && primitives.push(contact.primitive);
  for (const Contact& twin : set.twins) all = all && primitives.push(twin.primitive);
  return all;
}

bool holdsBy(const ContactSet& set, const Plane& plane) {
  return std::any_of(set.planes.begin(), set.planes.end(),
                     [&](const Plane& other) { return other.normal == plane.normal && other.offset == plane.offset; });
}

void moveContacts(ContactSet& set, const Vec3& step) {
  for (std::size_t i = 0; i < set.contacts.size(); ++i) {
    Contact& contact = set.contacts[i];
    const double away = contact.plane.normal.dot(step);
    contact.point += step - away * contact.plane.normal;
    contact.distance += away;
    contact.plane.offset -= away;
    set.planes[i].offset = contact.plane.offset;
  }
}

void relaxToCentre(ContactSet& set) {
  for (std::size_t i = 0; i < set.contacts.size(); ++i) {
    set.contacts[i].plane.offset = std::min(set.contacts[i].plane.offset, 0.0);
    set.planes[i].offset = set.contacts[i].plane.offset;
  }
}

Mat3 curvedDirections(const Contact& contact, const SceneAt& scene) {
  if (contact.feature == Feature::kFace) return Mat3::Zero();
  const Vec3& n = contact.plane.normal;
  Mat3 tangents = Mat3::Identity() - n * n.transpose();
  if (contact.feature >= Feature::kVertex0 || scene.kind(contact.primitive) == PrimitiveKind::kPoint) return tangents;
  const Vec3 edge = scene.edge(contact.primitive, contact.feature);
  return tangents - edge * edge.transpose();
}

}  // namespace hl
