// Surface: what the scene and the user say about the surface of a primitive: material, textures, vertex normals.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "base/vec.h"
#include "scene/scene_at.h"

namespace hl {

/// A place on a primitive, as the closest-point query gives it.
struct SurfacePoint {
  PrimitiveId primitive;
  Vec3 normal = Vec3::UnitZ();             ///< true one: unit, toward the proxy
  std::array<double, 3> weights{1, 0, 0};  ///< of the primitive's sorted vertices
};

/// A quantity of one surface: a number, or what an image says within a range.
struct SurfaceValue {
  double low = 0, range = 0;
  const Texture* texture = nullptr;  ///< nullptr: `low` everywhere
  double at(const Vec2& texcoord) const { return texture ? low + range * texture->sample(texcoord) : low; }
};

/// Some pointers; made anew wherever it is asked, for the scene and what the user set must outlive it. RT-safe.
class Surface {
 public:
  Surface(const SceneAt& scene, const MaterialOverride& set, PrimitiveId id);

  bool isTriangle() const { return triangle_; }
  /// Whether it is to be shaded by the normals of its vertices.
  bool smooth() const { return smooth_; }
  /// At a corner of the triangle that this is, where it is smooth; frame of its object.
  Vec3 normal(const Primitive& triangle, std::size_t sorted) const {
    return shape_.cornerNormal(id_, triangle, sorted);
  }

  /// Whether a texture modulates the quantity, or any of them.
  bool textured(Quantity quantity) const {
    return mapped_ && material_.textureOf(quantity).used() && !overridden(quantity);
  }
  bool textured() const;
  /// Of a textured triangle: at a vertex, or where the weights say.
  const Vec2& texcoord(std::size_t sorted) const { return shape_.model.texcoords[corner(sorted)]; }
  Vec2 texcoord(const std::array<double, 3>& weights) const {
    return weights[0] * texcoord(0) + weights[1] * texcoord(1) + weights[2] * texcoord(2);
  }

  /// kHeight without a texture is 0.
  SurfaceValue read(Quantity quantity) const;
  /// Of a quantity that no texture modulates.
  double plain(Quantity quantity) const { return overridden(quantity).value_or(number(quantity)); }

 private:
  std::size_t corner(std::size_t sorted) const { return shape_.model.triangles[source_][order_[sorted]]; }
  /// The number that the user set for a quantity everywhere, if any.
  const std::optional<double>& overridden(Quantity quantity) const;
  double number(Quantity quantity) const;

  const MaterialOverride& set_;
  const ElementId id_;
  const Shape& shape_;
  const Surfaces& surfaces_;
  const Material& material_;
  bool triangle_, smooth_, mapped_;
  ElementId source_ = 0;                 // as Primitive has it, of a mapped triangle
  std::array<std::uint8_t, 3> order_{};  // the same
};

inline const std::optional<double>& Surface::overridden(Quantity quantity) const {
  static constexpr std::optional<double> kNever;
  return quantity == Quantity::kHeight ? kNever : set_.number(static_cast<std::size_t>(quantity));
}

inline double Surface::number(Quantity quantity) const {
  return quantity == Quantity::kHeight ? 0 : material_.*kMaterialNumbers[static_cast<std::size_t>(quantity)];
}

inline SurfaceValue Surface::read(Quantity quantity) const {
  if (const auto& set = overridden(quantity)) return {*set};
  if (!textured(quantity)) return {number(quantity)};
  const TextureUse& use = material_.textureOf(quantity);
  return {use.low, use.high - use.low, surfaces_.textures[use.texture].get()};
}

}  // namespace hl
