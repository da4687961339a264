// Surface: the surface properties of a primitive, from the scene and the user: material, textures, vertex normals.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>

#include "base/vec.h"
#include "scene/scene_at.h"

namespace hl {

/// A point of a primitive, as the closest-point query returns it.
struct SurfacePoint {
  PrimitiveId primitive;
  Vec3 normal = Vec3::UnitZ();             ///< true normal: unit, toward the proxy
  std::array<double, 3> weights{1, 0, 0};  ///< barycentric, for the primitive's sorted vertices
};

/// A quantity of one surface: a constant, or a texture value mapped to a range.
struct SurfaceValue {
  double low = 0, range = 0;
  const Texture* texture = nullptr;  ///< nullptr: `low` everywhere
  double at(const Vec2& texcoord) const { return texture ? low + range * texture->sample(texcoord) : low; }
};

/// Holds only references, so it is created for each use. The scene and the user's settings must outlive it. RT-safe.
class Surface {
 public:
  Surface(const SceneAt& scene, const MaterialOverride& set, PrimitiveId id);

  bool isTriangle() const { return triangle_; }
  /// Whether shading by vertex normals is on; of a point of a surface that is no mesh: by its normal.
  bool smooth() const { return smooth_; }
  /// Whether vertex normals identify the outside; else the opposite of each is as good.
  bool hasOutside() const { return shape_.hasOutside(); }
  /// Vertex normal of a smooth triangle or point, in the object frame. `sorted`: number among the sorted vertices.
  Vec3 normal(const Primitive& triangle, std::size_t sorted) const {
    return shape_.cornerNormal(id_, triangle, sorted);
  }

  /// Whether a texture modulates this quantity; without an argument: any quantity.
  bool textured(Quantity quantity) const {
    return mapped_ && material_.textureOf(quantity).used() && !overridden(quantity);
  }
  bool textured() const;
  /// Texture coordinates of a textured triangle at a vertex, or at barycentric weights.
  Vec2 texcoord(std::size_t sorted) const { return shape_.cornerTexcoord(source_, order_[sorted]); }
  Vec2 texcoord(const std::array<double, 3>& weights) const {
    return weights[0] * texcoord(0) + weights[1] * texcoord(1) + weights[2] * texcoord(2);
  }

  /// The quantity as a constant or a texture. kHeight without a texture is 0.
  SurfaceValue read(Quantity quantity) const;
  /// At barycentric weights, 0..1.
  double stiffness(const std::array<double, 3>& weights) const;
  /// The value of a quantity that no texture modulates.
  double plain(Quantity quantity) const { return overridden(quantity).value_or(number(quantity)); }

 private:
  /// The value that the user set for the quantity on all surfaces, if any.
  const std::optional<double>& overridden(Quantity quantity) const;
  double number(Quantity quantity) const;

  const MaterialOverride& set_;
  const ElementId id_;
  const Shape& shape_;
  const Surfaces& surfaces_;
  const Material& material_;
  bool triangle_, smooth_, mapped_;
  ElementId source_ = 0;                 // Primitive::source, for a mapped triangle
  std::array<std::uint8_t, 3> order_{};  // Primitive::order, for a mapped triangle
};

inline const std::optional<double>& Surface::overridden(Quantity quantity) const {
  static constexpr std::optional<double> kNever;
  return quantity == Quantity::kHeight ? kNever : set_.number(static_cast<std::size_t>(quantity));
}

inline double Surface::number(Quantity quantity) const {
  return quantity == Quantity::kHeight ? 0 : material_.*kMaterialNumbers[static_cast<std::size_t>(quantity)];
}

/// Of the quantities that no texture modulates and that are 0 by default (adhesion, compliance, strength): the value of
/// this one on the surface of a primitive. RT-safe.
inline double constantOf(const SceneAt& scene, const MaterialOverride& set, PrimitiveId id, Quantity quantity) {
  const auto i = static_cast<std::size_t>(quantity);
  if (const auto& said = set.number(i)) return *said;
  const Instance& instance = scene.instance(id);
  if (instance.plain) return 0;
  return instance.surfaces->materials[scene.shape(id).materialOf(id.element)].*kMaterialNumbers[i];
}

/// Whether a texture may modulate the quantity on the surface of a primitive; known without reading the primitive.
/// RT-safe.
inline bool mayBeTextured(const SceneAt& scene, const MaterialOverride& set, PrimitiveId id, Quantity quantity) {
  const Instance& instance = scene.instance(id);
  if (instance.plain || !set.textures || set.number(static_cast<std::size_t>(quantity))) return false;
  return instance.surfaces->materials[scene.shape(id).materialOf(id.element)].textureOf(quantity).used();
}

inline double Surface::stiffness(const std::array<double, 3>& weights) const {
  const SurfaceValue value = read(Quantity::kStiffness);
  return std::clamp(value.texture ? value.at(texcoord(weights)) : value.low, 0.0, 1.0);
}

inline SurfaceValue Surface::read(Quantity quantity) const {
  if (const auto& set = overridden(quantity)) return {*set};
  if (!textured(quantity)) return {number(quantity)};
  const TextureUse& use = material_.textureOf(quantity);
  return {use.low, use.high - use.low, surfaces_.textures[use.texture].get()};
}

}  // namespace hl
