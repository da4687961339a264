#include "proxy/element_motion.h"

namespace hl {

Vec3 displacementOf_O(const SceneAt& scene, const MeshTransition& way, PrimitiveId element,
                      const std::array<double, 3>& weights, std::int64_t from_ns, std::int64_t to_ns) {
  const Primitive& primitive = scene.primitive(element);
  if (primitive.kind != way.to()->primitives.elementKind(element.element)) return Vec3::Zero();
  const auto before = way.corners(element.element, way.part(from_ns));
  const auto after = way.corners(element.element, way.part(to_ns));
  Vec3 gone_O = Vec3::Zero();
  for (std::size_t i = 0; i < 3; ++i) gone_O += weights[i] * (after[primitive.order[i]] - before[primitive.order[i]]);
  return gone_O;
}

}  // namespace hl
