// Material: how a surface feels. Each quantity is a number, or a texture that moves it within a stated range.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace hl {

/// What a texture can modulate. kHeight is a bump map: it bends the normal and moves nothing.
enum class Quantity : std::uint8_t { kStiffness, kStaticFriction, kDynamicFriction, kViscosity, kHeight };
inline constexpr std::size_t kQuantities = 5;

/// Texture number `texture` of the scene gives the quantity low + (high - low) * texel, in the quantity's unit
/// (kHeight: m).
struct TextureUse {
  static constexpr std::uint32_t kNone = 0xffffffff;
  std::uint32_t texture = kNone;
  double low = 0;
  double high = 1;
  bool used() const { return texture != kNone; }
  bool operator==(const TextureUse&) const = default;
};

struct Material {
  double stiffness = 1;         ///< s in 0..1: the part of the servo's spring that this surface uses
  double static_friction = 0;   ///< mu_s >= 0; below dynamic_friction it counts as dynamic_friction
  double dynamic_friction = 0;  ///< mu_d >= 0
  double viscosity_Ns_m = 0;    ///< b >= 0 at the hand: drag per speed of the proxy
  double stribeck_m_s = 0;      ///< > 0: mu falls from mu_s to mu_d as exp(-(v / stribeck)^2); 0: at once
  double presliding_N_m = 0;    ///< > 0: a stuck proxy creeps on a spring of this stiffness; 0: it does not move
  bool smooth = false;          ///< force shading by vertex normals (HL_SMOOTH); else HL_FLAT
  std::array<TextureUse, kQuantities> textures{};

  const TextureUse& textureOf(Quantity quantity) const { return textures[static_cast<std::size_t>(quantity)]; }
  TextureUse& textureOf(Quantity quantity) { return textures[static_cast<std::size_t>(quantity)]; }
  bool operator==(const Material&) const = default;
};

/// What a user sets for every surface at once, over what the scene says; what is not set stays as it is.
/// A number set here also replaces the texture of its quantity.
struct MaterialOverride {
  std::optional<double> stiffness, static_friction, dynamic_friction, viscosity_Ns_m;
  std::optional<bool> smooth;
  bool textures = true;  ///< false: every texture is left out

  /// Whether it leaves the default material, which has no textures, what it is.
  bool keepsDefault() const { return !(stiffness || static_friction || dynamic_friction || viscosity_Ns_m || smooth); }
};

}  // namespace hl
