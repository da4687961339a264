#include "proxy/curvature_step.h"

#include <cmath>

namespace hl {

namespace {

// Newton's step is a tangent of at most 45 degrees on the obstacle; farther away the plain step is as good.
constexpr double kLongestPerReach = 1.0;

// Below this change of the step the curvature is not worth leaving the surface for.
constexpr double kWorthwhile = 1e-3;

// Two orthonormal tangents of a unit normal.
void tangentsOf(const Vec3& normal, Vec3& a, Vec3& b) {
  a = normal.unitOrthogonal();
  b = normal.cross(a);
}

// Newton's step on one surface: the 2x2 system on its tangent plane. False unless positive definite.
bool solveOnSurface(const Mat3& hessian, const Vec3& normal, const Vec3& plain, Vec3& step) {
  Vec3 a, b;
  tangentsOf(normal, a, b);
  const double haa = a.dot(hessian * a);
  const double hab = a.dot(hessian * b);
  const double hbb = b.dot(hessian * b);
  const double det = haa * hbb - hab * hab;
  if (haa <= 0 || hbb <= 0 || det <= 0) return false;
  const double ra = a.dot(plain);
  const double rb = b.dot(plain);
  step = ((hbb * ra - hab * rb) / det) * a + ((haa * rb - hab * ra) / det) * b;
  return true;
}

// Newton's step along the curve in which two surfaces meet.
bool solveOnCurve(const Mat3& hessian, const Vec3& n0, const Vec3& n1, const Vec3& plain, Vec3& step) {
  const Vec3 along = n0.cross(n1).normalized();
  const double h = along.dot(hessian * along);
  if (!(h > 0)) return false;
  step = (along.dot(plain) / h) * along;
  return true;
}

bool staysAbove(const ContactSet& set, const Vec3& step, double tolerance) {
  for (const Plane& plane : set.planes) {
    if (plane.normal.dot(step) < plane.offset - tolerance) return false;
  }
  return true;
}

}  // namespace

bool curvatureStep(const ContactSet& set, const SceneAt& scene, const SolverResult& sub_goal, double reach,
                   Vec3& step) {
  if (sub_goal.active_count < 1 || sub_goal.active_count > 2) return false;
  Mat3 hessian = Mat3::Identity();
  bool curved = false;
  for (std::size_t i = 0; i < sub_goal.active_count; ++i) {
    const Contact& contact = set.contacts[sub_goal.active[i]];
    if (contact.feature == Feature::kFace) continue;
    curved = true;
    hessian -= (sub_goal.multiplier[i] / contact.distance) * curvedDirections(contact, scene);
  }
  if (!curved) return false;
  const Vec3& n0 = set.contacts[sub_goal.active[0]].plane.normal;
  const Vec3& plain = sub_goal.point;
  const bool solved = sub_goal.active_count == 1
                          ? solveOnSurface(hessian, n0, plain, step)
                          : solveOnCurve(hessian, n0, set.contacts[sub_goal.active[1]].plane.normal, plain, step);
  return solved && step.allFinite() && step.norm() <= kLongestPerReach * reach &&
         (step - plain).norm() > kWorthwhile * plain.norm() && staysAbove(set, step, 1e-12 * reach);
}

}  // namespace hl
