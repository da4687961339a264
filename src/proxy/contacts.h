// Contacts: the primitives that touch the proxy, as planes of configuration space, in an order given by geometry alone.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "base/fixed_vector.h"
#include "base/vec.h"
#include "geometry/closest_point.h"
#include "proxy/solver.h"
#include "proxy/sweep_cache.h"
#include "scene/scene_at.h"

namespace hl {

/// A primitive within reach of the proxy.
struct Contact {
  Plane plane;                ///< relative to the proxy's centre
  Vec3 point = Vec3::Zero();  ///< on the primitive, nearest the proxy
  double distance = 0;        ///< m, from the proxy's centre
  Feature feature = Feature::kFace;
  PrimitiveId primitive;
  std::array<double, 3> weights{1, 0, 0};  ///< of `point` in the primitive's sorted vertices
};

/// Room for contacts of one place. Coincident ones count once, so this many *different* planes within the skin. More of
/// them are a crowd, as at the bottom of a pit of many sides.
inline constexpr std::size_t kMaxContacts = 64;

inline constexpr std::size_t kMaxTwins = 256;

struct ContactSet {
  FixedVector<Contact, kMaxContacts> contacts;
  FixedVector<Plane, kMaxContacts> planes;  ///< contacts[i].plane, for the solver
  /// Primitives that share the edge or vertex of a contact and with it the plane, bit by bit. Of more than there is
  /// room for none is kept: which ones are met first must not count.
  FixedVector<Contact, kMaxTwins> twins;
  bool twins_lost = false;
  /// There is no room for all: those are left out that `toward` goes into least, and all twins.
  bool crowd = false;
};

/// All primitives within `distance` of `centre`, as planes that hold the centre `reach` away from them.
/// Sorted by plane; of bitwise equal planes the primitive that precedes() is the contact, the others are twins.
/// RT-safe.
void gatherContacts(const SceneAt& scene, const Vec3& centre, double distance, double reach, ContactSet& set);
/// The same, looking only through what is `nearby`; where that does not cover the place, it does afterwards. `toward`:
/// where the proxy is to go; it says who stays of a crowd.
void gatherContacts(const SceneAt& scene, const Vec3& centre, const Vec3& toward, double distance, double reach,
                    SweepCache& nearby, ContactSet& set);

/// What the set was made from: its contacts and twins. Returns false when there are more. RT-safe.
bool primitivesOf(const ContactSet& set, FixedVector<PrimitiveId, SweepCache::kRoom>& primitives);

/// Whether one of the contacts holds the proxy off by this plane, bit by bit. RT-safe.
bool holdsBy(const ContactSet& set, const Plane& plane);

/// Whether two contacts hold the proxy off by the same plane, bit by bit. RT-safe.
inline bool samePlane(const Contact& a, const Contact& b) {
  return a.plane.normal == b.plane.normal && a.plane.offset == b.plane.offset;
}

/// The set after the proxy has moved by `step` (m) and every contact has stayed on its face. RT-safe.
void moveContacts(ContactSet& set, const Vec3& step);

/// Lets every plane pass through the centre at least: used when the exact offsets contradict each other by rounding.
void relaxToCentre(ContactSet& set);

/// Directions, as an orthogonal projector, in which a contact's configuration-space obstacle is curved with radius
/// `distance`: none for a face, across the edge for an edge, all tangents for a vertex.
Mat3 curvedDirections(const Contact& contact, const SceneAt& scene);

}  // namespace hl
