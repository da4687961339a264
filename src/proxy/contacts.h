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
  /// Primitives that share the edge or vertex of a contact, and so its plane, bit by bit. If there are more than there
  /// is room for, none is kept: the order in which they are met must not change the result.
  FixedVector<Contact, kMaxTwins> twins;
  bool twins_lost = false;
  /// There are more contacts than room. Those are kept that `toward` goes into most, and no twins.
  bool crowd = false;
};

/// All primitives within `distance` of `centre`, as planes that keep the centre `reach` away from them.
/// Sorted by plane; of bitwise equal planes the primitive that precedes() is the contact, the others are twins.
/// RT-safe.
void gatherContacts(const SceneAt& scene, const Vec3& centre, double distance, double reach, ContactSet& set);
/// The same from the cache `nearby`, which is filled first where it does not cover the place. `toward`: the way that
/// the proxy wants to go; it decides which contacts of a crowd are kept.
void gatherContacts(const SceneAt& scene, const Vec3& centre, const Vec3& toward, double distance, double reach,
                    SweepCache& nearby, ContactSet& set);

/// The primitives of the set's contacts and twins. Returns false when there are more than fit. RT-safe.
bool primitivesOf(const ContactSet& set, FixedVector<PrimitiveId, SweepCache::kRoom>& primitives);

/// Whether one of the contacts has this plane, bit by bit. RT-safe.
bool holdsBy(const ContactSet& set, const Plane& plane);

/// Whether two contacts have the same plane, bit by bit. RT-safe.
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
