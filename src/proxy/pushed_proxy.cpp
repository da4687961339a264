#include "proxy/pushed_proxy.h"

#include <optional>

#include "proxy/element_motion.h"

namespace hl {

namespace {

struct CarrierTouch {
  PrimitiveId primitive;
  ClosestPoint nearest;
};

// Where the carrier touches the proxy, if it does: its nearest primitive.
std::optional<CarrierTouch> touchOfCarrier(const PushedProxy& proxy, const SceneAt& scene) {
  std::optional<CarrierTouch> found;
  const double touching = accuracy::kTouchingDeforming * proxy.tolerance.reach;
  scene.primitivesWithin(proxy.position, touching, [&](PrimitiveId id, const ClosestPoint& place) {
    if (id.instance != proxy.carrier) return;
    if (found && place.distance > found->nearest.distance) return;
    if (found && place.distance == found->nearest.distance && !scene.precedes(id, found->primitive)) return;
    found = {id, place};
  });
  return found;
}

// Displacement of the carrier's contact point until `time_ns` by the deformation of its mesh; frame of the carrier.
Vec3 deformedBy(const PushedProxy& proxy, const MeshTransition& way, std::int64_t time_ns) {
  const SceneAt scene = proxy.scene();
  const std::optional<CarrierTouch> held = touchOfCarrier(proxy, scene);
  if (!held) return Vec3::Zero();
  return displacementOf_O(scene, way, held->primitive, held->nearest.weights, proxy.now_ns, time_ns);
}

}  // namespace

Vec3 PushedProxy::carriedTo(std::int64_t time_ns) const {
  if (carrier == kNoInstance) return position;
  const Instance& by = snapshot().instances[carrier];
  Vec3 place = by.poses().at(now_ns).toObject(position);
  if (const MeshTransition* const way = by.transitionAt(now_ns)) place += deformedBy(*this, *way, time_ns);
  return by.poses().at(time_ns).toWorld(place);
}

Box PushedProxy::regionOf(const Vec3& way_end) const {
  const Vec3 margin = Vec3::Constant(convergence::kNearPerReach * tolerance.reach);
  return {position.cwiseMin(way_end) - margin, position.cwiseMax(way_end) + margin};
}

std::uint32_t movingInstance(const SceneAt& scene, std::uint64_t key) {
  std::uint32_t number = 0;
  if (key == 0 || !scene.snapshot().find(key, number) || scene.leavesOut(number)) return kNoInstance;
  const Instance& found = scene.snapshot().instances[number];
  return found.poses().moves() || found.mesh_motion ? number : kNoInstance;
}

}  // namespace hl
