// Surface: what a contact feels like where it is touched: material, textures, and the bent normal of the paper's
// section 4.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "base/vec.h"
#include "geometry/closest_point.h"
#include "scene/scene_at.h"

namespace hl {

/// The paper's "usually less than 30 degrees": a shaded normal farther from the true one is turned back to this.
/// Bending by beta can add up to 1/cos^2(beta) - 1 of the spring's energy, a third at 30 degrees.
inline constexpr double kShadingLimit_rad = 0.5235987755982988;

/// A place on a primitive, as the closest-point query gives it.
struct SurfacePlace {
  PrimitiveId primitive;
  Vec3 normal = Vec3::UnitZ();             ///< true one: unit, toward the proxy
  std::array<double, 3> weights{1, 0, 0};  ///< of the primitive's sorted vertices
};

/// A normal bent by force shading and by a bump map, and how much each has bent it: 1 - cos of the angle.
struct BentNormal {
  Vec3 normal = Vec3::UnitZ();
  double shading = 0;
  double bump = 0;
  bool bent() const { return shading > 0 || bump > 0; }
};

/// A quantity of one surface: a number, or what an image says within a range.
struct SurfaceValue {
  double low = 0, range = 0;
  const Texture* texture = nullptr;  ///< nullptr: `low` everywhere
  double at(const Vec2& texcoord) const { return texture ? low + range * texture->sample(texcoord) : low; }
};

/// Reads the surfaces of a scene; two pointers, made anew for every tick. RT-safe.
class SurfaceReader {
 public:
  SurfaceReader(const SceneAt& scene, const MaterialOverride& set) : scene_(scene), set_(set) {}

  /// Some surface may be shaded or bumped; when false, bend() gives the true normal everywhere.
  bool mayBend(PrimitiveId primitive) const { return smooth(primitive) || textured(primitive, Quantity::kHeight); }

  /// Interpolates the vertex normals with the weights of the place, limits their angle to the true normal, and adds
  /// the slope of the bump map. A triangle with a vertex normal that is missing, zero or points to the other side has
  /// its true normal everywhere.
  BentNormal bend(const SurfacePlace& place) const;

  /// A quantity of the material (never kHeight), or its texture.
  SurfaceValue read(Quantity quantity, PrimitiveId primitive) const;
  double value(Quantity quantity, const SurfacePlace& place) const {
    const SurfaceValue found = read(quantity, place.primitive);
    return found.texture ? found.at(texcoord(place)) : found.low;
  }
  /// Of a textured triangle only; linear in the weights of the place.
  Vec2 texcoord(const SurfacePlace& place) const;
  double stribeck_m_s(PrimitiveId primitive) const { return material(primitive).stribeck_m_s; }
  double presliding_N_m(PrimitiveId primitive) const { return material(primitive).presliding_N_m; }

  /// Whether a texture modulates the quantity on this primitive.
  bool textured(PrimitiveId primitive, Quantity quantity) const;
  /// Whether friction or viscosity change along this primitive.
  bool dragTextured(PrimitiveId primitive) const;
  /// The place after the contact has moved by `step` in the plane of its triangle; beyond the edge the triangle's
  /// plane goes on.
  SurfacePlace moved(const SurfacePlace& place, const Vec3& step) const;

 private:
  const Shape& shape(PrimitiveId primitive) const { return *scene_.instance(primitive).shape; }
  const Surfaces& surfaces(PrimitiveId primitive) const { return *scene_.instance(primitive).surfaces; }
  const Material& material(PrimitiveId primitive) const {
    return surfaces(primitive).materials[shape(primitive).materialOf(primitive.element)];
  }
  bool smooth(PrimitiveId primitive) const {
    return set_.smooth.value_or(material(primitive).smooth) && !shape(primitive).model.normals.empty();
  }
  /// The number that the user set for a quantity everywhere, if any.
  const std::optional<double>& overridden(Quantity quantity) const;
  const Texture& textureOf(PrimitiveId primitive, Quantity quantity) const {
    return *surfaces(primitive).textures[material(primitive).textureOf(quantity).texture];
  }
  const Vec3& vertexNormal(PrimitiveId id, std::size_t sorted) const;
  const Vec2& vertexTexcoord(PrimitiveId id, std::size_t sorted) const;
  // In the frame of the object.
  void shade(const SurfacePlace& place, BentNormal& bent) const;
  void bump(const SurfacePlace& place, BentNormal& bent) const;

  const SceneAt& scene_;
  const MaterialOverride& set_;
};

}  // namespace hl
