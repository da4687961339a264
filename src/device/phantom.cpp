#include "device/phantom.h"

#include <algorithm>
#include <cmath>

namespace hl {

namespace {

// The coefficients of M: M11 = a + b cos 2q2 + c cos 2q3 + d cos q2 sin q3, M23 = -e sin(q2 - q3), M22 and M33
// constant.
struct MassTerms {
  double a, b, c, d, m22, m33, e;
};

MassTerms massTerms(const PhantomParameters& p) {
  const double l1 = p.l1 * p.l1, l2 = p.l2 * p.l2, l3 = p.l3 * p.l3;
  MassTerms t{};
  t.a = (4 * (p.Ia.y() + p.Ia.z() + p.Ibe.y() + p.Ibe.z() + p.Ic.y() + p.Ic.z() + p.Idf.y() + p.Idf.z()) +
         8 * p.Ibase_yy + 4 * l1 * p.ma + l2 * p.ma + l1 * p.mc + 4 * l3 * p.mc) /
        8;
  t.b = (4 * (p.Ibe.y() - p.Ibe.z() + p.Ic.y() - p.Ic.z()) + l1 * (4 * p.ma + p.mc)) / 8;
  t.c = (4 * (p.Ia.y() - p.Ia.z() + p.Idf.y() - p.Idf.z()) - l2 * p.ma - 4 * l3 * p.mc) / 8;
  t.d = p.l1 * (p.l2 * p.ma + p.l3 * p.mc);
  t.m22 = (4 * (p.Ibe.x() + p.Ic.x() + l1 * p.ma) + l1 * p.mc) / 4;
  t.m33 = (4 * p.Ia.x() + 4 * p.Idf.x() + l2 * p.ma + 4 * l3 * p.mc) / 4;
  t.e = t.d / 2;
  return t;
}

// How far q is beyond [low, high]; negative below.
double beyond(double q, double low, double high) { return q - std::clamp(q, low, high); }

double beyondFold(const PhantomParameters& p, const Vec3& q) {
  return beyond(q.z() - q.y(), p.q3_less_q2_min, p.q3_less_q2_max);
}

double stopTorque(const PhantomParameters& p, double beyond_rad, double rate) {
  return beyond_rad == 0 ? 0 : -p.stop_stiffness_Nm_rad * beyond_rad - p.stop_damping_Nms_rad * rate;
}

}  // namespace

Vec3 phantomTip(const PhantomParameters& p, const Vec3& q) {
  const double r = p.l1 * std::cos(q.y()) + p.l2 * std::sin(q.z());
  return {r * std::cos(q.x()), r * std::sin(q.x()), p.l1 * std::sin(q.y()) - p.l2 * std::cos(q.z())};
}

Mat3 phantomJacobian(const PhantomParameters& p, const Vec3& q) {
  const double c1 = std::cos(q.x()), s1 = std::sin(q.x());
  const double r = p.l1 * std::cos(q.y()) + p.l2 * std::sin(q.z());
  const double r2 = -p.l1 * std::sin(q.y());
  const double r3 = p.l2 * std::cos(q.z());
  Mat3 j;
  j << -r * s1, r2 * c1, r3 * c1,  //
      r * c1, r2 * s1, r3 * s1,    //
      0, p.l1 * std::cos(q.y()), p.l2 * std::sin(q.z());
  return j;
}

// In the plane of the arm, (r, z) = l1 (cos q2, sin q2) + l2 (sin q3, -cos q3): two links, the second at q3 - 90
// degrees.
bool phantomJoints(const PhantomParameters& p, const Vec3& x, Vec3& q) {
  const double r = std::hypot(x.x(), x.y());
  const double reach2 = r * r + x.z() * x.z();
  const double cos_elbow = (reach2 - p.l1 * p.l1 - p.l2 * p.l2) / (2 * p.l1 * p.l2);
  if (!(std::abs(cos_elbow) < 1)) return false;
  const double elbow = -std::acos(cos_elbow);  // link 2 hangs down from link 1
  const double shoulder = std::atan2(x.z(), r) - std::atan2(p.l2 * std::sin(elbow), p.l1 + p.l2 * std::cos(elbow));
  q = Vec3(std::atan2(x.y(), x.x()), shoulder, shoulder + elbow + M_PI / 2);
  return true;
}

Mat3 phantomMass(const PhantomParameters& p, const Vec3& q) {
  const MassTerms t = massTerms(p);
  Mat3 m = Mat3::Zero();
  m(0, 0) = t.a + t.b * std::cos(2 * q.y()) + t.c * std::cos(2 * q.z()) + t.d * std::cos(q.y()) * std::sin(q.z());
  m(1, 1) = t.m22;
  m(2, 2) = t.m33;
  m(1, 2) = m(2, 1) = -t.e * std::sin(q.y() - q.z());
  if (p.with_rotors) m.diagonal() += p.rotor_inertia * p.gear.cwiseProduct(p.gear);
  return m;
}

// With A = dM11/dq2, B = dM11/dq3, D = dM23/dq2 = -dM23/dq3:
//   h1 = (A q2' + B q3') q1',   h2 = -A/2 q1'^2 - D q3'^2,   h3 = -B/2 q1'^2 + D q2'^2.
Vec3 phantomCoriolis(const PhantomParameters& p, const Vec3& q, const Vec3& qdot) {
  const MassTerms t = massTerms(p);
  const double A = -2 * t.b * std::sin(2 * q.y()) - t.d * std::sin(q.y()) * std::sin(q.z());
  const double B = -2 * t.c * std::sin(2 * q.z()) + t.d * std::cos(q.y()) * std::cos(q.z());
  const double D = -t.e * std::cos(q.y() - q.z());
  const double v1 = qdot.x(), v2 = qdot.y(), v3 = qdot.z();
  return {(A * v2 + B * v3) * v1, -A / 2 * v1 * v1 - D * v3 * v3, -B / 2 * v1 * v1 + D * v2 * v2};
}

Vec3 phantomStops(const PhantomParameters& p, const Vec3& q, const Vec3& qdot) {
  Vec3 torque;
  for (int i = 0; i < 3; ++i) torque[i] = stopTorque(p, beyond(q[i], p.q_min[i], p.q_max[i]), qdot[i]);
  const double fold = stopTorque(p, beyondFold(p, q), qdot.z() - qdot.y());
  return torque + Vec3(0, -fold, fold);
}

double phantomStopEnergy_J(const PhantomParameters& p, const Vec3& q) {
  double squares = std::pow(beyondFold(p, q), 2);
  for (int i = 0; i < 3; ++i) squares += std::pow(beyond(q[i], p.q_min[i], p.q_max[i]), 2);
  return 0.5 * p.stop_stiffness_Nm_rad * squares;
}

// Projected Gauss-Seidel. Only joints 2 and 3 are coupled, and weakly; from the last step's impulse, which hardly
// changes, a few rounds leave a rest far below one encoder count per second.
Vec3 phantomFriction(const PhantomParameters& p, const Mat3& mass, const Vec3& qdot, double dt_s, Vec3& impulse) {
  constexpr int kRounds = 4;
  const Mat3 mobility = mass.inverse();
  const double most = p.joint_friction_Nm * dt_s;
  impulse = impulse.cwiseMax(-most).cwiseMin(most);
  Vec3 rate = qdot + mobility * impulse;
  for (int round = 0; round < kRounds; ++round) {
    for (int i = 0; i < 3; ++i) {
      const double next = std::clamp(impulse[i] - rate[i] / mobility(i, i), -most, most);
      rate += mobility.col(i) * (next - impulse[i]);
      impulse[i] = next;
    }
  }
  return rate;
}

}  // namespace hl
