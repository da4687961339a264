#include "geometry/sweep.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/closest_point.h"
#include "geometry/features.h"

// A sphere of radius R against a primitive is a point against the primitive grown by R. For a triangle this is the
// union of a slab (the face moved by R to both sides), three finite cylinders about the edges and three spheres about
// the vertices. Each part lies within the union, so the first contact is the earliest of the parts. Neighbouring parts
// are tangent, so if rounding misses a part at its border, its neighbour gives an error of second order only.
//
// Round parts, with w = from - centre (sphere), or the components of w and m across the axis (cylinder, unit vector e):
//   |w + t m|^2 = R^2   <=>   a t^2 + 2 b t + c = 0,  a = m.m,  b = w.m,  c = (|w| - R)(|w| + R)
// The discriminant b^2 - a c loses digits for distant starts. By Lagrange's identity |w|^2 |m|^2 - (w.m)^2 = |w x m|^2,
//   disc = R^2 |m|^2 - |w x m|^2 = (R |m| - k)(R |m| + k),   k = |w x m|
// and the first root without cancellation, as b < 0 for an approach, is t = c / (-b + sqrt(disc)). Across an axis |w|,
// |m| and w.m become |w x e|, |m x e| and (w x e).(m x e), and k = |(w x m).e|.

namespace hl {

namespace {

// First root of a round part in [0, 1]; false if there is none. A start inside by rounding (c <= 0) counts as touching.
bool firstRoot(double distance, double speed, double b, double k, double radius, double& t) {
  if (!(b < 0)) return false;  // moves away, or does not move
  const double c = (distance - radius) * (distance + radius);
  if (c <= 0) {
    t = 0;
    return true;
  }
  const double disc = (radius * speed - k) * (radius * speed + k);
  if (!(disc >= 0)) return false;
  t = c / (-b + std::sqrt(disc));
  return t <= 1;
}

// Whether the moving point always stays farther than R from the centre or axis, k > R |m|, by more than the rounding
// error. Computed from squares, so that most parts need no square root. All other cases are left to firstRoot().
bool passesBy(double k2, double speed2, double radius) {
  constexpr double kRounding = 1e-12;
  return k2 > (1 + kRounding) * radius * radius * speed2;
}

void hitVertex(const Primitive& primitive, std::size_t vertex, const Vec3& from, const Vec3& motion, double radius,
               double& limit, Impact& out) {
  const Vec3 w = from - primitive.vertex[vertex];
  const double b = w.dot(motion);
  const Vec3 k = w.cross(motion);
  if (!(b < 0) || passesBy(k.squaredNorm(), motion.squaredNorm(), radius)) return;
  double t = 0;
  if (!firstRoot(w.norm(), motion.norm(), b, k.norm(), radius, t) || !(t < limit)) return;
  limit = t;
  out.t = t;
  out.feature = vertexFeature(vertex);
  out.normal = (w + t * motion).normalized();
  out.weights = vertexWeights(vertex);
}

void hitEdge(const Primitive& primitive, std::size_t number, Feature feature, const Vec3& from, const Vec3& motion,
             double radius, double& limit, Impact& out) {
  const Edge& edge = kEdges[number];
  const Vec3 along = primitive.vertex[edge.end] - primitive.vertex[edge.begin];
  const Vec3 w = from - primitive.vertex[edge.begin];
  const Vec3 w_long = w.cross(along), m_long = motion.cross(along);  // components across the edge, times its length
  const double k_long = w.cross(motion).dot(along);
  if (!(w_long.dot(m_long) < 0) || passesBy(k_long * k_long, m_long.squaredNorm(), radius)) return;
  const double length = along.norm();
  const Vec3 e = along / length;
  const Vec3 w_across = w.cross(e);
  const Vec3 m_across = motion.cross(e);
  double t = 0;
  if (!firstRoot(w_across.norm(), m_across.norm(), w_across.dot(m_across), std::abs(w.cross(motion).dot(e)), radius, t))
    return;
  if (!(t < limit)) return;
  // The cylinder ends at the vertices; beyond them the spheres are hit.
  const Vec3 at = w + t * motion;
  const double s = at.dot(e) / length;
  if (!(s >= 0 && s <= 1)) return;
  limit = t;
  out.t = t;
  out.feature = feature;
  out.normal = (at - s * along).normalized();
  out.weights = edgeWeights(edge, s);
}

// The slab between the two offset faces, which contains the whole obstacle. Times are fractions of the motion.
struct Slab {
  double side;       // side of the face on which the motion starts
  double closing;    // m, toward the face
  double enters;     // time of entry; 0: the motion starts within the slab
  double no_sooner;  // lower bound of any impact, despite rounding of distances
};

Slab slabOf(const Primitive& triangle, const Vec3& from, const Vec3& motion, double radius) {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  constexpr double kRounding = 1e-12;  // of the lengths from which heights and edge roots are computed
  const Vec3 w = from - triangle.vertex[0];
  const double height = triangle.normal.dot(w);
  const double side = height < 0 ? -1.0 : 1.0;
  const double closing = -side * triangle.normal.dot(motion);
  const double gap = std::abs(height) - radius;
  const double surely = gap - kRounding * (w.lpNorm<1>() + motion.lpNorm<1>() + radius);
  const auto after = [&](double way) { return way <= 0 ? 0 : closing > 0 ? way / closing : kNever; };
  return {side, closing, after(gap), after(surely)};
}

// The obstacle lies within the slab, so nothing else is hit earlier.
bool hitFace(const Primitive& triangle, const Slab& slab, const Vec3& from, const Vec3& motion, Impact& out) {
  if (!(slab.closing > 0 && slab.enters <= 1)) return false;
  const FaceAreas areas = faceAreas(triangle, from + slab.enters * motion);
  if (!areas.inside()) return false;
  out.t = slab.enters;
  out.feature = Feature::kFace;
  out.normal = slab.side * triangle.normal;
  out.weights = areas.weights();
  return true;
}

constexpr double kNone = 2;  // any time above 1

bool hitVertices(const Primitive& primitive, const Vec3& from, const Vec3& motion, double radius, double limit,
                 Impact& out) {
  const auto vertices = static_cast<std::size_t>(primitive.kind);
  for (std::size_t i = 0; i < vertices; ++i) hitVertex(primitive, i, from, motion, radius, limit, out);
  return limit < kNone;
}

// No impact is reported before `no_sooner`. So a search for the first impact of many primitives may skip this one if
// `no_sooner` is too late, with the same result.
bool hitTriangle(const Primitive& triangle, const Vec3& from, const Vec3& motion, double radius, double latest,
                 Impact& out) {
  const Slab slab = slabOf(triangle, from, motion, radius);
  if (slab.no_sooner > std::min(latest, 1.0)) return false;
  if (hitFace(triangle, slab, from, motion, out)) return true;
  double limit = kNone;
  for (std::size_t i = 0; i < 3; ++i) hitEdge(triangle, i, edgeFeature(i), from, motion, radius, limit, out);
  if (!hitVertices(triangle, from, motion, radius, limit, out)) return false;
  out.t = std::max(out.t, slab.no_sooner);
  return true;
}

}  // namespace

bool sweepSphereFromOutside(const Primitive& primitive, const Vec3& from, const Vec3& motion, double radius,
                            double latest, Impact& out) {
  if (primitive.kind == PrimitiveKind::kTriangle) return hitTriangle(primitive, from, motion, radius, latest, out);
  double limit = kNone;
  if (primitive.kind == PrimitiveKind::kSegment)
    hitEdge(primitive, 2, Feature::kEdge0, from, motion, radius, limit, out);
  return hitVertices(primitive, from, motion, radius, limit, out);
}

bool sweepSphere(const Primitive& primitive, const Vec3& from, const Vec3& motion, double radius, Impact& out) {
  return sweepSphere(primitive, closestPoint(primitive, from), from, motion, radius, out);
}

bool sweepSphere(const Primitive& primitive, const ClosestPoint& start, const Vec3& from, const Vec3& motion,
                 double radius, Impact& out) {
  if (start.distance > radius) return sweepSphereFromOutside(primitive, from, motion, radius, 1, out);
  if (!(motion.dot(start.normal) < 0)) return false;
  out.t = 0;
  out.feature = start.feature;
  out.normal = start.normal;
  out.weights = start.weights;
  return true;
}

}  // namespace hl
