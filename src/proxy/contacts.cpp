#include "proxy/contacts.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include "geometry/queries.h"

namespace hl {

namespace {

auto key(const Contact& c) {
  return std::tuple(c.plane.normal.x(), c.plane.normal.y(), c.plane.normal.z(), c.plane.offset, c.point.x(),
                    c.point.y(), c.point.z());
}

// Direction of the edge a contact lies on; edge i is opposite vertex i, and a segment's only edge joins vertices 0
// and 1.
Vec3 edgeDirection(const Primitive& primitive, Feature feature) {
  if (primitive.kind == PrimitiveKind::kSegment) return (primitive.vertex[1] - primitive.vertex[0]).normalized();
  const int opposite = static_cast<int>(feature) - static_cast<int>(Feature::kEdge0);
  const auto from = static_cast<std::size_t>((opposite + 1) % 3);
  const auto to = static_cast<std::size_t>((opposite + 2) % 3);
  return (primitive.vertex[to] - primitive.vertex[from]).normalized();
}

}  // namespace

void gatherContacts(const Snapshot& snapshot, const Vec3& centre, double distance, double reach, ContactSet& set) {
  set.contacts.clear();
  set.planes.clear();
  set.twins.clear();
  set.overflow = false;
  const auto add = [&](std::uint32_t primitive, const ClosestPoint& closest) {
    Contact contact{{closest.normal, reach - closest.distance},
                    closest.point,
                    closest.distance,
                    closest.feature,
                    primitive,
                    closest.weights};
    const auto same = [&](const Contact& other) { return samePlane(contact, other); };
    auto* twin = std::find_if(set.contacts.begin(), set.contacts.end(), same);
    if (twin == set.contacts.end()) {
      set.overflow |= !set.contacts.push(contact);
      return;
    }
    if (twin->primitive == primitive) return;  // the index may offer a primitive twice
    if (precedes(snapshot.primitives[primitive], snapshot.primitives[twin->primitive])) std::swap(*twin, contact);
    set.twins.push(contact);
  };
  primitivesWithin(*snapshot.index, snapshot.primitives, centre, distance, add);
  std::sort(set.contacts.begin(), set.contacts.end(),
            [](const Contact& a, const Contact& b) { return key(a) < key(b); });
  for (const Contact& contact : set.contacts) set.planes.push(contact.plane);
}

void relaxToCentre(ContactSet& set) {
  for (std::size_t i = 0; i < set.contacts.size(); ++i) {
    set.contacts[i].plane.offset = std::min(set.contacts[i].plane.offset, 0.0);
    set.planes[i].offset = set.contacts[i].plane.offset;
  }
}

Mat3 curvedDirections(const Contact& contact, const Primitive& primitive) {
  if (contact.feature == Feature::kFace) return Mat3::Zero();
  const Vec3& n = contact.plane.normal;
  Mat3 tangents = Mat3::Identity() - n * n.transpose();
  if (contact.feature >= Feature::kVertex0 || primitive.kind == PrimitiveKind::kPoint) return tangents;
  const Vec3 edge = edgeDirection(primitive, contact.feature);
  return tangents - edge * edge.transpose();
}

}  // namespace hl
