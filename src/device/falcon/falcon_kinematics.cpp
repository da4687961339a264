#include "device/falcon/falcon_kinematics.h"

#include <cmath>

namespace hl {

namespace {

// Stamper's letters, m. a: thigh; b: shin; d and e: from the shin's ends to its joints; c, f and r, s: from the tip and
// from the middle of the base to the leg, along its plane and across.
constexpr double a = 0.060, b = 0.1025, c = 0.01443, d = 0.01125, e = d, f = -0.025, r = 0.040, s = -0.02309;
// Directions of the legs, rad: 120 degrees apart, the first 15 degrees from upright.
constexpr double kDirections[3] = {105 * M_PI / 180, -15 * M_PI / 180, -135 * M_PI / 180};

// Of the shin's far joint in a leg's frame: u outward, v across, w toward the user.
struct Joint {
  double u, v, w;
};

Joint jointOf(const Vec3& tip_F, int leg) {
  const double cosine = std::cos(kDirections[leg]), sine = std::sin(kDirections[leg]);
  return {cosine * tip_F.x() + sine * tip_F.y() - r + c, -sine * tip_F.x() + cosine * tip_F.y() - s + f, tip_F.z()};
}

// The part of the shin across the leg's plane is v; this is the rest.
double shinWithout(double v) { return d + e + std::sqrt(b * b - v * v); }

}  // namespace

// Thigh and shin are two sides of a triangle whose third goes to the joint; the knee is outward.
bool falconAngles(const Vec3& tip_F, Vec3& angles) {
  for (int leg = 0; leg < 3; ++leg) {
    const Joint q = jointOf(tip_F, leg);
    if (!(std::abs(q.v) < b)) return false;
    const double shin = shinWithout(q.v);
    const double reach = std::hypot(q.u, q.w);
    const double cosine = (reach * reach + a * a - shin * shin) / (2 * a * reach);
    if (!(std::abs(cosine) < 1)) return false;
    angles[leg] = std::atan2(q.w, q.u) - std::acos(cosine);
  }
  return true;
}

// From |q - a (cos, sin)|^2 = shin(v)^2, by the derivative of an implicit function.
Mat3 falconAngleRates(const Vec3& tip_F, const Vec3& angles) {
  Mat3 rates;
  for (int leg = 0; leg < 3; ++leg) {
    const Joint q = jointOf(tip_F, leg);
    const double cosine = std::cos(angles[leg]), sine = std::sin(angles[leg]);
    const double along_u = q.u - a * cosine, along_w = q.w - a * sine;
    const double along_v = shinWithout(q.v) * q.v / std::sqrt(b * b - q.v * q.v);
    const double by_angle = a * (along_u * sine - along_w * cosine);
    const double cos_leg = std::cos(kDirections[leg]), sin_leg = std::sin(kDirections[leg]);
    rates.row(leg) << -(cos_leg * along_u - sin_leg * along_v), -(sin_leg * along_u + cos_leg * along_v), -along_w;
    rates.row(leg) /= by_angle;
  }
  return rates;
}

// Newton; from one sample of the encoders to the next one step is enough. From far away a full step could leave the
// workspace: then a shorter one.
bool falconTip(const Vec3& angles, Vec3& tip_F) {
  constexpr int kMaxSteps = 40;
  constexpr double kClose_rad = 1e-10;
  constexpr double kLongestStep_m = 0.02;
  Vec3 tip = tip_F, there;
  double longest_m = kLongestStep_m;
  if (!falconAngles(tip, there)) return false;
  for (int i = 0; i < kMaxSteps; ++i) {
    const Vec3 missing = angles - there;
    if (missing.norm() < kClose_rad) {
      tip_F = tip;
      return true;
    }
    const Vec3 next = tip + limited(falconAngleRates(tip, there).inverse() * missing, longest_m);
    Vec3 next_angles;
    if (falconAngles(next, next_angles)) {
      tip = next;
      there = next_angles;
    } else {
      longest_m /= 2;
    }
  }
  return false;
}

// The power is the same on both sides: force = rates' * torques.
bool falconTorques(const Vec3& tip_F, const Vec3& angles, const Vec3& force_F, Vec3& torques_Nm) {
  torques_Nm = falconAngleRates(tip_F, angles).transpose().inverse() * force_F;
  return torques_Nm.allFinite();
}

}  // namespace hl
