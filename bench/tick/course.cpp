#include "tick/course.h"

#include <cmath>

namespace hl::bench {

namespace {

constexpr double kFlat = 0.3;      // smallest side of a flat scene over its next one
constexpr double kMargin = 0.35;   // of a side: as far from the middle of a flat scene as the course goes
constexpr double kBelow_m = 0.02;  // under a flat scene
constexpr double kCore = 0.25;     // of the largest half side: closer to the middle all directions are one

}  // namespace

Course::Course(const Box& bounds) : middle_(bounds.centre()) {
  const Vec3 size = bounds.size();
  size.minCoeff(&thin_);
  const double a = size[(thin_ + 1) % 3], b = size[(thin_ + 2) % 3];
  flat_ = size[thin_] < kFlat * std::min(a, b);
  if (flat_) {
    reach_m_ = kMargin * std::min(a, b);
    top_m_ = 0.5 * size[thin_];
    bottom_m_ = -0.5 * size[thin_] - kBelow_m;
  } else {
    reach_m_ = 0.5 * size.maxCoeff();
    top_m_ = 0.5 * size.norm();
    bottom_m_ = kCore * reach_m_;
  }
}

Vec3 Course::at(double s_m, double level_m) const {
  const double s = s_m / reach_m_;
  if (flat_) {
    Vec3 p = middle_;
    p[thin_] += level_m;
    p[(thin_ + 2) % 3] += reach_m_ * std::sin(1.618 * s) * std::cos(0.3 * s);
    p[(thin_ + 1) % 3] += reach_m_ * std::sin(s);
    return p;
  }
  // Away from the poles, where the meshes of round things are unlike the rest.
  const double azimuth = s, height = 0.9 * std::sin(0.618 * s + 0.4);
  const double side = std::cos(height);
  return middle_ + level_m * Vec3(side * std::sin(azimuth), std::sin(height), side * std::cos(azimuth));
}

double Course::levelOf(const Vec3& p) const { return flat_ ? (p - middle_)[thin_] : (p - middle_).norm(); }

Vec3 Course::up(const Vec3& p) const {
  if (flat_) return Vec3::Unit(thin_);
  const Vec3 out = p - middle_;
  return out.norm() > 0 ? Vec3(out.normalized()) : Vec3(Vec3::UnitY());
}

}  // namespace hl::bench
