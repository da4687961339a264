// Contacts: the primitives that touch the proxy, as planes of configuration space. Their order depends on the geometry
// alone, not on the order of the search.
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
  std::array<double, 3> weights{1, 0, 0};  ///< barycentric weights of `point` for the primitive's sorted vertices
};

/// Maximum number of contacts at one position. Contacts with bitwise equal planes count once, so this is the number of
/// different planes within the skin. A larger number is a crowd, as at the bottom of a pit with many sides.
inline constexpr std::size_t kMaxContacts = 64;

inline constexpr std::size_t kMaxTwins = 256;

struct ContactSet {
  FixedVector<Contact, kMaxContacts> contacts;
  FixedVector<Plane, kMaxContacts> planes;  ///< contacts[i].plane, for the solver
  /// Primitives that share the edge or vertex of a contact, and so have the same plane bit by bit. If they do not all
  /// fit, none is kept, as the result must not depend on the order of the search.
  FixedVector<Contact, kMaxTwins> twins;
  bool twins_lost = false;
  /// There were too many contacts. Those were dropped whose planes the motion `toward` enters least, and all twins.
  bool crowd = false;
};

/// Fills `set` with all primitives within `distance` of `centre`, as planes that keep the centre `reach` away from
/// them. Sorted by plane. Of bitwise equal planes, the primitive that comes first by precedes() is the contact, and the
/// others are twins; of copies the one that is harder at its point, where textures say so. RT-safe.
void gatherContacts(const SceneAt& scene, const Vec3& centre, double distance, double reach, ContactSet& set);
/// The same, but searches only the cache `nearby`. If the cache does not cover `centre`, the scene is searched and the
/// cache filled. `toward`: the intended motion; it decides which contacts of a crowd are kept. `surfaces`: the user's
/// settings; the function above knows none.
void gatherContacts(const SceneAt& scene, const Vec3& centre, const Vec3& toward, double distance, double reach,
                    SweepCache& nearby, ContactSet& set, const MaterialOverride& surfaces = {});

/// Lists the contacts and twins of the set. Returns false if there are too many. RT-safe.
bool primitivesOf(const ContactSet& set, FixedVector<PrimitiveId, cost::kKnownRoom>& primitives);

/// Whether a contact of the set has this plane, bit by bit. RT-safe.
bool holdsBy(const ContactSet& set, const Plane& plane);

/// Whether two contacts have the same plane, bit by bit. RT-safe.
inline bool samePlane(const Contact& a, const Contact& b) {
  return a.plane.normal == b.plane.normal && a.plane.offset == b.plane.offset;
}

/// Updates the set for a proxy that has moved by `step` (m), when every contact has stayed on its face. RT-safe.
void moveContacts(ContactSet& set, const Vec3& step);

/// Lowers the offset of every plane so that the centre is feasible (offset <= 0). Used when the exact offsets
/// contradict each other by rounding.
void relaxToCentre(ContactSet& set);

/// Orthogonal projector on the directions in which the contact's configuration-space obstacle is curved with radius
/// `distance`: none for a face, across the edge for an edge, all tangents for a vertex.
Mat3 curvedDirections(const Contact& contact, const SceneAt& scene);

}  // namespace hl
