// Material: the haptic properties of a surface. Each quantity (base/quantities.def) is a constant, or a texture mapped
// to a range.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "base/quantities.h"

namespace hl {

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
#define HL_QUANTITY(quantity, field, NAME, unit, most, otherwise, ...) double field = otherwise;
#include "base/quantities.def"
#undef HL_QUANTITY
  bool smooth = false;  ///< force shading by vertex normals (HL_SMOOTH); else HL_FLAT
  std::array<TextureUse, kQuantities> textures{};

  const TextureUse& textureOf(Quantity quantity) const { return textures[static_cast<std::size_t>(quantity)]; }
  TextureUse& textureOf(Quantity quantity) { return textures[static_cast<std::size_t>(quantity)]; }
  bool operator==(const Material&) const = default;
};

/// The constant of each quantity except kHeight, in the order of the table.
inline constexpr std::array<double Material::*, kNumbers> kMaterialNumbers{
#define HL_QUANTITY(quantity, field, ...) &Material::field,
#include "base/quantities.def"
#undef HL_QUANTITY
};

/// The same for a structure in which each of them is optional.
template <typename Said>
inline constexpr std::array<std::optional<double> Said::*, kNumbers> kSaidNumbers{
#define HL_QUANTITY(quantity, field, ...) &Said::field,
#include "base/quantities.def"
#undef HL_QUANTITY
};

/// User settings for all surfaces, which override the scene; quantities that are not set are unchanged. A number set
/// here also replaces the texture of its quantity.
struct MaterialOverride {
#define HL_QUANTITY(quantity, field, ...) std::optional<double> field;
#include "base/quantities.def"
#undef HL_QUANTITY
  std::optional<bool> smooth;
  bool textures = true;  ///< false: textures are ignored

  const std::optional<double>& number(std::size_t i) const { return this->*kSaidNumbers<MaterialOverride>[i]; }
  std::optional<double>& number(std::size_t i) { return this->*kSaidNumbers<MaterialOverride>[i]; }
  /// Whether the default material, which has no textures, is unchanged by these settings.
  bool keepsDefault() const {
    for (std::size_t i = 0; i < kNumbers; ++i) {
      if (number(i)) return false;
    }
    return !smooth;
  }
};

}  // namespace hl
