#include "bodies/manifold.h"

#include <algorithm>
#include <bitset>
#include <cmath>
#include <limits>
#include <optional>

#include "bodies/cylinder.h"
#include "bodies/nearest_points.h"

namespace hl {

namespace {

constexpr double kUnparted = std::numeric_limits<double>::infinity();
// By so much of the size of the shapes another axis must part them farther than a face of b: bodies that slide over the
// seams of a flat mesh touch its faces, not the sides of the next triangle.
constexpr double kPreference = 1e-6;
// Squared sine between two edges below which they count as parallel: a face parts the shapes as well. So it does where
// the axis of two edges is nearly the normal of a face: one point where edges pass would be in the place of all that
// the face bears.
constexpr double kParallel = 1e-6;
constexpr std::size_t kMaxCorners = 64;  // of a polygon while it is clipped
// Of the size of the smaller shape: where a grown shape is nearer than the points on a face by more than this, its end
// beside the face bears, and the face does not.
constexpr double kBesideFace = 1e-4;

struct Axis {
  Vec3 normal = Vec3::UnitZ();  // from b toward a
  double separation = -kUnparted;
  std::size_t face = 0;                          // of a or b
  std::size_t direction_a = 0, direction_b = 0;  // of edges
};

double lowest(std::span<const Vec3> vertices, const Vec3& direction) {
  double least = kUnparted;
  for (const Vec3& vertex : vertices) least = std::min(least, direction.dot(vertex));
  return least;
}

// The face of `of` that parts it farthest from `other`; the normal points away from `of`. One that parts them by more
// than `margin` ends the search.
Axis bestFace(const PlacedConvex& of, const PlacedConvex& other, double margin) {
  const double radii = of.shape->radius + other.shape->radius;
  Axis best;
  for (std::size_t face = 0; face < of.normals.size(); ++face) {
    const Vec3& normal = of.normals[face];
    const double separation =
        lowest(other.vertices, normal) - normal.dot(of.vertices[of.shape->faces[face].corners[0]]);
    if (separation > best.separation) best = {normal, separation, face, 0, 0};
    if (separation - radii > margin) break;
  }
  return best;
}

Vec3 directionOf(const PlacedConvex& of, std::size_t number) {
  const auto& ends = of.shape->directions[number];
  return of.vertices[ends[1]] - of.vertices[ends[0]];
}

// Directions of edges, one bit each.
constexpr std::size_t kMaxDirections = 3 * kMaxVertices - 6;
using Directions = std::bitset<kMaxDirections>;

// Those of edges that come below this height along the normal.
Directions directionsBelow(const PlacedConvex& of, const Vec3& normal, double height) {
  Directions some;
  for (const Convex::Edge& edge : of.shape->edges) {
    if (some[edge.direction]) continue;
    some[edge.direction] = std::min(normal.dot(of.vertices[edge.begin]), normal.dot(of.vertices[edge.end])) <= height;
  }
  return some;
}

// Edges meet where no point of them is farther than `near` (m) from the other shape. All of b lies below its highest
// vertex along the normal of a face, all of a above its lowest: edges of a that are higher, and edges of b that are
// lower, do not meet.
Axis bestEdges(const PlacedConvex& a, const PlacedConvex& b, const Vec3& face_normal, double near) {
  Axis best;
  const Directions of_a = directionsBelow(a, face_normal, near - lowest(b.vertices, -face_normal));
  const Directions of_b = directionsBelow(b, -face_normal, near - lowest(a.vertices, face_normal));
  for (std::size_t i = 0; i < a.shape->directions.size(); ++i) {
    if (!of_a[i]) continue;
    const Vec3 da = directionOf(a, i);
    for (std::size_t j = 0; j < b.shape->directions.size(); ++j) {
      if (!of_b[j]) continue;
      const Vec3 db = directionOf(b, j);
      Vec3 normal = da.cross(db);
      const double square = normal.squaredNorm();
      if (square <= kParallel * da.squaredNorm() * db.squaredNorm()) continue;
      normal /= std::sqrt(square);
      if (normal.dot(a.centre - b.centre) < 0) normal = -normal;
      const double separation = lowest(a.vertices, normal) + lowest(b.vertices, -normal);
      if (separation > best.separation) best = {normal, separation, 0, i, j};
    }
  }
  return best;
}

// The edge of this direction that lies farthest along `toward`.
const Convex::Edge& extremeEdge(const PlacedConvex& of, std::size_t direction, const Vec3& toward) {
  const Convex::Edge* best = nullptr;
  double farthest = -kUnparted;
  for (const Convex::Edge& edge : of.shape->edges) {
    if (edge.direction != direction) continue;
    const double along = toward.dot(of.vertices[edge.begin] + of.vertices[edge.end]);
    if (along > farthest) {
      farthest = along;
      best = &edge;
    }
  }
  return *best;
}

using ManifoldPoints = FixedVector<ManifoldPoint, kMaxCorners>;

// Adds the point halfway between `on_a` and `on_b`, which lie `distance` apart along the normal before the shapes are
// grown.
template <typename Points>
void addPoint(Points& points, const Vec3& normal, const Vec3& on_a, double distance, double radius_a, double radius_b,
              double margin) {
  const double gap = distance - radius_a - radius_b;
  if (gap <= margin) points.push({on_a - (radius_a + gap / 2) * normal, gap});
}

// All, if there is room; else the deepest, and one by one that which is farthest from those that are there.
void keepSpread(ManifoldPoints& found, Manifold& out) {
  if (found.size() <= Manifold::kMaxPoints) {
    for (const ManifoldPoint& point : found) out.points.push(point);
    return;
  }
  std::array<double, kMaxCorners> from_others;
  from_others.fill(kUnparted);
  std::size_t next = 0;
  for (std::size_t i = 1; i < found.size(); ++i) {
    if (found[i].gap < found[next].gap) next = i;
  }
  while (out.points.push(found[next])) {
    const Vec3 last = found[next].point;
    for (std::size_t i = 0; i < found.size(); ++i) {
      from_others[i] = std::min(from_others[i], (found[i].point - last).squaredNorm());
      if (from_others[i] > from_others[next]) next = i;
    }
  }
}

using Polygon = FixedVector<Vec3, kMaxCorners>;

// What `of` turns toward the face: the face most opposed to its normal, or a whole segment. Of a cylinder's side it is
// the line that touches: the next edge of the prism would hold it up as it rolls.
Polygon incidentPolygon(const PlacedConvex& of, std::size_t opposed) {
  Polygon polygon;
  if (of.normals.empty()) {
    for (const Vec3& vertex : of.vertices) polygon.push(vertex);
    return polygon;
  }
  if (of.turned_edge && opposed >= kCylinderEnds) {
    polygon.push(of.vertices[0]);
    polygon.push(of.vertices[1]);
    return polygon;
  }
  for (const Convex::Index corner : of.shape->faces[opposed].corners) polygon.push(of.vertices[corner]);
  return polygon;
}

// The face most opposed to the normal, of those for which `counts` is true; at least one.
template <typename Counts>
std::size_t mostOpposed(const PlacedConvex& of, const Vec3& normal, const Counts& counts) {
  std::size_t opposed = 0;
  double least = kUnparted;
  for (std::size_t face = 0; face < of.normals.size(); ++face) {
    const double along = of.normals[face].dot(normal);
    if (along >= least || !counts(face)) continue;
    opposed = face;
    least = along;
  }
  return opposed;
}

// The face most opposed to the normal may not have the lowest vertex, where faces of unlike sizes meet.
struct IncidentFaces {
  IncidentFaces(const PlacedConvex& of, const Vec3& normal, double slack) {
    if (of.normals.empty()) return;
    opposed = mostOpposed(of, normal, [](std::size_t) { return true; });
    const double low = lowest(of.vertices, normal) + slack;
    const auto is_low = [&](std::size_t face) {
      const auto& corners = of.shape->faces[face].corners;
      return std::any_of(corners.begin(), corners.end(),
                         [&](Convex::Index corner) { return normal.dot(of.vertices[corner]) <= low; });
    };
    if (!isRound(of) && !is_low(opposed)) low_one = mostOpposed(of, normal, is_low);
  }

  std::size_t opposed = 0;
  std::optional<std::size_t> low_one;
};

// Sutherland and Hodgman: keeps what lies below the plane, and what is above by no more than `slack` (m), so that the
// corners of blocks that stand flush on each other all stay.
Polygon clipped(const Polygon& polygon, const Vec3& from, const Vec3& outward, double slack) {
  Polygon kept;
  const std::size_t corners = polygon.size();
  for (std::size_t i = 0; i < corners; ++i) {
    const Vec3 &here = polygon[i], &next = polygon[(i + 1) % corners];
    const double above = outward.dot(here - from) - slack, above_next = outward.dot(next - from) - slack;
    if (above <= 0) kept.push(here);
    const bool way_back = corners == 2 && i == 1;  // of a segment
    if (!way_back && ((above < 0 && above_next > 0) || (above > 0 && above_next < 0)))
      kept.push(here + above / (above - above_next) * (next - here));
  }
  return kept;
}

// `reference` has the face, whose normal points to `incident`. `sign`: 1 if the reference is b.
void clipAgainstFace(const PlacedConvex& reference, std::size_t face, const PlacedConvex& incident, double sign,
                     double slack, double margin, Manifold& out) {
  const Vec3& normal = reference.normals[face];
  const auto& corners = reference.shape->faces[face].corners;
  out.normal = sign * normal;
  const double radius_i = incident.shape->radius, radius_r = reference.shape->radius;
  ManifoldPoints found;
  const auto add = [&](std::size_t opposed) {
    Polygon polygon = incidentPolygon(incident, opposed);
    for (std::size_t i = 0; i < corners.size() && !polygon.empty(); ++i) {
      const Vec3& from = reference.vertices[corners[i]];
      const Vec3& to = reference.vertices[corners[(i + 1) % corners.size()]];
      polygon = clipped(polygon, from, (to - from).cross(normal).normalized(), slack);
    }
    for (const Vec3& corner : polygon) {
      const double distance = normal.dot(corner - reference.vertices[corners[0]]);
      const Vec3 on_a = sign > 0 ? corner : Vec3(corner - distance * normal);
      addPoint(found, out.normal, on_a, distance, sign > 0 ? radius_i : radius_r, sign > 0 ? radius_r : radius_i,
               margin);
    }
  };
  const IncidentFaces faces(incident, normal, slack);
  if (faces.low_one) add(*faces.low_one);
  add(faces.opposed);
  keepSpread(found, out);
}

// Where the two edges pass each other, if they do within their lengths.
void crossEdges(const PlacedConvex& a, const PlacedConvex& b, const Axis& axis, double margin, Manifold& out) {
  const Convex::Edge& ea = extremeEdge(a, axis.direction_a, -axis.normal);
  const Convex::Edge& eb = extremeEdge(b, axis.direction_b, axis.normal);
  const Vec3 &a0 = a.vertices[ea.begin], &b0 = b.vertices[eb.begin];
  const Vec3 da = a.vertices[ea.end] - a0, db = b.vertices[eb.end] - b0, r = a0 - b0;
  const double aa = da.squaredNorm(), bb = db.squaredNorm(), ab = da.dot(db);
  const double determinant = aa * bb - ab * ab;
  const double s = (ab * db.dot(r) - bb * da.dot(r)) / determinant;
  const double t = (aa * db.dot(r) - ab * da.dot(r)) / determinant;
  if (s < 0 || s > 1 || t < 0 || t > 1) return;
  out.normal = axis.normal;
  addPoint(out.points, out.normal, a0 + s * da, axis.separation, a.shape->radius, b.shape->radius, margin);
}

bool pointAndPolytope(const PlacedConvex& point, const PlacedConvex& polytope, double sign, double margin,
                      Manifold& out) {
  const NearestPoints nearest = nearestToPoint(point.vertices[0], polytope);
  out.normal = sign * nearest.normal;
  const Vec3& on_a = sign > 0 ? nearest.on_a : nearest.on_b;
  addPoint(out.points, out.normal, on_a, nearest.distance, sign > 0 ? point.shape->radius : polytope.shape->radius,
           sign > 0 ? polytope.shape->radius : point.shape->radius, margin);
  return !out.points.empty();
}

double leastGapOf(const Manifold& manifold) {
  double least = kUnparted;
  for (const ManifoldPoint& point : manifold.points) least = std::min(least, point.gap);
  return least;
}

bool manifoldOfPolytopes(const PlacedConvex& a, const PlacedConvex& b, double margin, Manifold& out) {
  out.points.clear();
  if (a.vertices.size() == 1) return pointAndPolytope(a, b, 1, margin, out);
  if (b.vertices.size() == 1) return pointAndPolytope(b, a, -1, margin, out);
  const double radii = a.shape->radius + b.shape->radius;
  const Axis of_b = bestFace(b, a, margin);
  if (of_b.separation - radii > margin) return false;
  const Axis of_a = bestFace(a, b, margin);
  if (of_a.separation - radii > margin) return false;
  const double of_faces = std::max(of_a.separation, of_b.separation);
  const Vec3 face_normal = of_a.separation > of_b.separation ? Vec3(-of_a.normal) : of_b.normal;
  const Axis of_edges = bestEdges(a, b, face_normal, std::max(margin + radii, -of_faces));
  if (of_edges.separation - radii > margin) return false;
  const double preference = kPreference * std::min(a.shape->reach, b.shape->reach > 0 ? b.shape->reach : kUnparted);
  const double best_face = std::max(of_b.separation, of_a.separation - preference);
  const bool edges_part = of_edges.separation > best_face + preference;
  const bool face_of_a = of_a.separation > of_b.separation + preference;
  if (!edges_part || of_edges.normal.cross(face_of_a ? of_a.normal : of_b.normal).squaredNorm() <= kParallel) {
    if (face_of_a) {
      clipAgainstFace(a, of_a.face, b, -1, preference, margin, out);
    } else if (of_b.separation > -kUnparted) {
      clipAgainstFace(b, of_b.face, a, 1, preference, margin, out);
    }
  }
  if (edges_part && out.points.empty()) crossEdges(a, b, of_edges, margin, out);
  // Clipping cuts off what of a grown shape reaches round the rim of the face.
  const double slack = preference / kPreference * kBesideFace;
  const double least = leastGapOf(out);
  if (!out.points.empty() && (!(radii > 0) || least <= best_face - radii + slack)) return true;
  NearestPoints nearest;
  if (!nearestPoints(a, b, nearest)) return !out.points.empty();
  if (least <= nearest.distance - radii + slack) return true;
  out.points.clear();
  out.normal = nearest.normal;
  addPoint(out.points, out.normal, nearest.on_a, nearest.distance, a.shape->radius, b.shape->radius, margin);
  return !out.points.empty();
}

// What the manifold of a prism gives of how the cylinder is to be turned: `sign` is 1 for a. Where a side of the prism
// was met by something narrow, the tangent plane there is the true one.
PlacedConvex turnedFor(const Manifold& rough, const PlacedConvex& cylinder, double sign, PlacedRoom& room) {
  const auto sides = cylinder.normals.subspan(kCylinderEnds);
  const Vec3 outward = -sign * rough.normal;
  if (std::find(sides.begin(), sides.end(), outward) == sides.end())
    return turnedPrism(cylinder, outward, PrismTurn::kEdge, room);
  const auto deepest = std::min_element(rough.points.begin(), rough.points.end(),
                                        [](const auto& x, const auto& y) { return x.gap < y.gap; });
  return turnedPrism(cylinder, radialOf(cylinder, deepest->point + deepest->gap / 2 * outward, outward),
                     PrismTurn::kSide, room);
}

bool isFaceOf(const PlacedConvex& shape, const Vec3& normal) {
  return std::any_of(shape.normals.begin(), shape.normals.end(),
                     [&](const Vec3& one) { return one == normal || one == -normal; });
}

bool manifoldOfTurned(const Manifold& rough, const PlacedConvex& a, const PlacedConvex& b, double margin,
                      Manifold& out) {
  PlacedRoom room_a, room_b;
  return manifoldOfPolytopes(isRound(a) ? turnedFor(rough, a, 1, room_a) : a,
                             isRound(b) ? turnedFor(rough, b, -1, room_b) : b, margin, out);
}

}  // namespace

bool findManifold(const PlacedConvex& a, const PlacedConvex& b, double margin, Manifold& out) {
  if (!isRound(a) && !isRound(b)) return manifoldOfPolytopes(a, b, margin, out);
  if (a.vertices.size() == 1 || b.vertices.size() == 1) return manifoldOfPolytopes(a, b, margin, out);
  if (!manifoldOfPolytopes(a, b, margin + roughnessOf(a, b), out)) return false;
  const Manifold rough = out;
  if (!manifoldOfTurned(rough, a, b, margin, out)) return false;
  const Manifold found = out;
  // Near the rim of a face it may have been turned for another normal than that of the face.
  const bool on_face = (!isRound(a) && isFaceOf(a, found.normal)) || (!isRound(b) && isFaceOf(b, found.normal));
  if (!on_face || found.normal == rough.normal) return true;
  if (!manifoldOfTurned(found, a, b, margin, out)) out = found;
  return true;
}

}  // namespace hl
