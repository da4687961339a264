#include "proxy/surface.h"

namespace hl {

Surface::Surface(const SceneAt& scene, const MaterialOverride& set, PrimitiveId id)
    : set_(set),
      id_(id.element),
      shape_(scene.shape(id)),
      surfaces_(*scene.instance(id).surfaces),
      material_(surfaces_.materials[shape_.materialOf(id.element)]),
      triangle_(scene.kind(id) == PrimitiveKind::kTriangle) {
  const bool has_normals = isTriangle() ? shape_.hasNormals() : shape_.source != nullptr;
  smooth_ = has_normals && set.smooth.value_or(material_.smooth);
  mapped_ = isTriangle() && set.textures && shape_.hasTexcoords();
  if (!mapped_) return;
  const Primitive& primitive = scene.primitive(id);
  source_ = primitive.source;
  order_ = primitive.order;
}

bool Surface::textured() const {
  if (!mapped_) return false;
  for (std::size_t i = 0; i < kQuantities; ++i) {
    if (textured(static_cast<Quantity>(i))) return true;
  }
  return false;
}

}  // namespace hl
