#include "bodies/joint.h"

namespace hl {

Joint jointAt(JointKind kind, const Vec3& anchor_W, const Vec3& axis_W, const Pose& pose_a, const Pose& pose_b) {
  const Vec3 axis = axis_W.normalized(), side = axis.unitOrthogonal();
  Joint joint;
  joint.kind = kind;
  joint.anchor_a = pose_a.toObject(anchor_W);
  joint.anchor_b = pose_b.toObject(anchor_W);
  joint.axis_a = pose_a.turnToObject(axis);
  joint.axis_b = pose_b.turnToObject(axis);
  joint.side_a = pose_a.turnToObject(side);
  joint.side_b = pose_b.turnToObject(side);
  return joint;
}

double springEnergy_J(const Joint& joint, double coordinate) {
  if (isRod(joint)) return 0;
  const double stretch = coordinate - joint.rest;
  return joint.spring * stretch * stretch / 2 + joint.table.energy_J(coordinate);
}

Joint distanceBetween(const Vec3& anchor_a_W, const Vec3& anchor_b_W, const Pose& pose_a, const Pose& pose_b) {
  Joint joint = jointAt(JointKind::kDistance, anchor_a_W, Vec3::UnitX(), pose_a, pose_b);
  joint.anchor_b = pose_b.toObject(anchor_b_W);
  joint.low = joint.high = joint.rest = (anchor_a_W - anchor_b_W).norm();
  return joint;
}

}  // namespace hl
