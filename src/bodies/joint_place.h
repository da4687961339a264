// Joint place: where a joint is in the world, its coordinate, and by how much its bodies are off it.
#pragma once

#include "bodies/joint.h"

namespace hl {

using Vec6 = Eigen::Matrix<double, 6, 1>;

/// The velocity that a row sees: line . (v_a - v_b) + turn_a . w_a - turn_b . w_b, v of the centres; and what one N s
/// (or N m s) of its impulse gives the bodies.
struct JointAxis {
  Vec3 line = Vec3::Zero(), turn_a = Vec3::Zero(), turn_b = Vec3::Zero();
};

/// The world frame.
struct JointPlace {
  JointPlace(const Joint& joint, const Pose& a, const Pose& b);

  const Joint& joint;
  Vec3 point_a, point_b;  ///< m, the anchors
  Vec3 axis_a, axis_b, side_a, side_b;

  Vec3 thirdSide_b() const { return axis_b.cross(side_b); }
  /// Of distance joints: from b to a, unit.
  Vec3 direction() const;
  /// m or rad; of a hinge the value nearest to `last`. RT-safe, as all below.
  double coordinate(double last) const;
  /// The coordinate's rate of change is the velocity along it. Centres of mass of the bodies, world frame.
  JointAxis alongCoordinate(const Vec3& centre_a, const Vec3& centre_b) const;
  /// The rows that hold, and how far off they are, m; angles count `lever_m` per rad.
  JointAxis row(std::size_t number, double lever_m, const Vec3& centre_a, const Vec3& centre_b) const;
  Vec6 off(double lever_m) const;

 private:
  /// Held along a direction at the anchors, or about it.
  struct Held {
    Vec3 direction;
    bool turns;
  };
  Held heldBy(std::size_t number) const;
  Vec3 offTurn() const;
};

}  // namespace hl
