#include "proxy/field_forces.h"

namespace hl {

namespace {

void add(const FieldSpec& field, const Instance& instance, const Pose& pose, const Vec3& finger, FieldForces& all) {
  const Vec3 finger_O = pose.toObject(finger);
  const Vec3 way_O = nearestOn(field.points, field.normal, finger_O).point - finger_O;
  const double distance_m = way_O.norm();
  if (!(distance_m < field.reach_m)) return;
  if (field.kind == FieldKind::kDrag) {
    all.damping_Ns_m += field.damping_Ns_m;
    return;
  }
  Vec3 force_O = pushOf_N(field, distance_m) * field.direction;
  if (distance_m > 0) force_O += pullOf_N(field, distance_m) / distance_m * way_O;
  const Vec3 force_N = pose.turnToWorld(force_O);
  // A constant force acts where the finger is, a pull at the place.
  const Vec3 point = field.kind == FieldKind::kConstant ? finger : Vec3(finger + pose.turnToWorld(way_O));
  if (all.forces.push({instance.key, point, force_N})) all.force_N += force_N;
}

}  // namespace

FieldForces fieldForces(const SceneAt& scene, const Vec3& finger) {
  FieldForces all;
  for (const PlacedField& placed : scene.snapshot().fields) {
    const Instance& instance = scene.snapshot().instances[placed.instance];
    add((*instance.fields)[placed.number], instance, instance.poses().at(scene.time_ns()), finger, all);
  }
  return all;
}

}  // namespace hl
