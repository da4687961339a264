// How near a place is to the nearest of all primitives, by looking at every one of them: shares no code with the proxy,
// its queries or its closest point. What is surely farther than the nearest so far is found by a ball around it.
#pragma once

#include <cmath>
#include <vector>

#include "geometry/judge.h"

namespace hl::soak {

class Clearance {
 public:
  explicit Clearance(const std::vector<Primitive>& primitives) : primitives_(primitives) {
    constexpr double kRounding = 1e-12;
    for (const Primitive& primitive : primitives) {
      const auto& v = primitive.vertex;
      const Vec3 centre = (v[0] + v[1] + v[2]) / 3;
      double radius = 0;
      for (const Vec3& vertex : v) radius = std::max(radius, (vertex - centre).norm());
      balls_.push_back({centre, radius + kRounding * (radius + centre.norm())});
    }
  }

  /// The distance of p to the nearest primitive, or `most` when none is nearer.
  double at(const Vec3& p, double most) const {
    double nearest = most;
    for (std::size_t i = 0; i < primitives_.size(); ++i) {
      const double reach = nearest + balls_[i].radius;
      if ((p - balls_[i].centre).squaredNorm() > reach * reach) continue;
      const auto distance = static_cast<double>(test::judgedDistance(primitives_[i], p.cast<test::Real>()));
      nearest = std::min(nearest, distance);
    }
    return nearest;
  }

 private:
  struct Ball {
    Vec3 centre;
    double radius;
  };
  const std::vector<Primitive>& primitives_;
  std::vector<Ball> balls_;
};

}  // namespace hl::soak
