#include "bodies/scenery.h"

#include <algorithm>

#include "base/clock.h"

namespace hl {

namespace {

double fastestOf_m_s(const Screw& screw, const Box& object) {
  constexpr double kArcOverChord = 1.6;  // of half a circle it is pi / 2
  if (!screw.moves()) return 0;
  double farthest = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 p((corner & 1) != 0 ? object.max.x() : object.min.x(),
                 (corner & 2) != 0 ? object.max.y() : object.min.y(),
                 (corner & 4) != 0 ? object.max.z() : object.min.z());
    farthest = std::max(farthest, (screw.to().toWorld(p) - screw.from().toWorld(p)).norm());
  }
  return kArcOverChord * farthest / seconds(screw.end_ns() - screw.begin_ns());
}

}  // namespace

Vec3 sceneryVelocity(const Instance& instance, const StepTimes& times, double period_s, const Vec3& point) {
  const PoseSource& poses = instance.poses();
  if (!poses.moves() || times.begin_ns >= poses.restsFrom_ns()) return Vec3::Zero();
  return (poses.at(times.end_ns).toWorld(poses.at(times.begin_ns).toObject(point)) - point) / period_s;
}

double fastestScenery_m_s(const Snapshot& scene) {
  double fastest = 0;
  for (const Instance& instance : scene.instances) {
    const Box& object = instance.shape->bounds;
    if (instance.driver || object.empty()) continue;
    fastest = std::max(
        {fastest, fastestOf_m_s(instance.motion.earlier(), object), fastestOf_m_s(instance.motion.last(), object)});
  }
  return fastest;
}

}  // namespace hl
