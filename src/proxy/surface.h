// Surface: what a contact feels like where it is touched: material, textures, and the bent normal of the paper's
// section 4.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "base/vec.h"
#include "geometry/closest_point.h"
#include "scene/snapshot.h"

namespace hl {

/// The paper's "usually less than 30 degrees": a shaded normal farther from the true one is turned back to this.
/// Bending by beta can add up to 1/cos^2(beta) - 1 of the spring's energy, a third at 30 degrees.
inline constexpr double kShadingLimit_rad = 0.5235987755982988;

/// A place on a primitive, as the closest-point query gives it.
struct SurfacePlace {
  std::uint32_t primitive = 0;
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

/// Reads the surfaces of one scene; two pointers and a limit, made anew for every tick. RT-safe.
class SurfaceReader {
 public:
  SurfaceReader(const Snapshot& snapshot, const MaterialOverride& set) : snapshot_(snapshot), set_(set) {}

  /// Some surface may be shaded or bumped; when false, bend() gives the true normal everywhere.
  bool mayBend(std::uint32_t primitive) const { return smooth(primitive) || textured(primitive, Quantity::kHeight); }

  /// Interpolates the vertex normals with the weights of the place, limits their angle to the true normal, and adds
  /// the slope of the bump map. A triangle with a vertex normal that is missing, zero or points to the other side has
  /// its true normal everywhere.
  BentNormal bend(const SurfacePlace& place) const;

  /// A quantity of the material (never kHeight), or its texture.
  SurfaceValue read(Quantity quantity, std::uint32_t primitive) const;
  double value(Quantity quantity, const SurfacePlace& place) const {
    const SurfaceValue found = read(quantity, place.primitive);
    return found.texture ? found.at(texcoord(place)) : found.low;
  }
  /// Of a textured triangle only; linear in the weights of the place.
  Vec2 texcoord(const SurfacePlace& place) const;
  double stribeck_m_s(std::uint32_t primitive) const { return material(primitive).stribeck_m_s; }
  double presliding_N_m(std::uint32_t primitive) const { return material(primitive).presliding_N_m; }

  /// Whether a texture modulates the quantity on this primitive.
  bool textured(std::uint32_t primitive, Quantity quantity) const;
  /// Whether friction or viscosity change along this primitive.
  bool dragTextured(std::uint32_t primitive) const;
  /// The place after the contact has moved by `step` in the plane of its triangle; beyond the edge the triangle's
  /// plane goes on.
  SurfacePlace moved(const SurfacePlace& place, const Vec3& step) const;

 private:
  const Material& material(std::uint32_t primitive) const { return snapshot_.materialOf(primitive); }
  bool smooth(std::uint32_t primitive) const {
    return set_.smooth.value_or(material(primitive).smooth) && !snapshot_.model.normals.empty();
  }
  /// The number that the user set for a quantity everywhere, if any.
  const std::optional<double>& overridden(Quantity quantity) const;
  const Texture& textureOf(std::uint32_t primitive, Quantity quantity) const {
    return snapshot_.model.textures[material(primitive).textureOf(quantity).texture];
  }
  const Vec3& vertexNormal(const Primitive& primitive, std::size_t sorted) const;
  const Vec2& vertexTexcoord(const Primitive& primitive, std::size_t sorted) const;
  void shade(const SurfacePlace& place, BentNormal& bent) const;
  void bump(const SurfacePlace& place, BentNormal& bent) const;

  const Snapshot& snapshot_;
  const MaterialOverride& set_;
};

}  // namespace hl
