// SurfaceChange: what one part of a hierarchy says about its surface. What it leaves out it takes from its caller.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "scene/material.h"

namespace hl {

/// A texture by the name that its scene knows it by.
struct NamedTextureUse {
  std::string texture;
  double low = 0, high = 1;  ///< as in TextureUse
  bool operator==(const NamedTextureUse&) const = default;
};

struct SurfaceChange {
#define HL_QUANTITY(quantity, field, ...) std::optional<double> field;
#include "base/quantities.def"
#undef HL_QUANTITY
  std::optional<bool> smooth;
  std::array<std::optional<NamedTextureUse>, kQuantities> textures{};
  bool untextured = false;  ///< without the textures of the caller

  /// This, and where it says nothing what the caller says.
  SurfaceChange over(const SurfaceChange& caller) const;
  /// The material it comes to; what nobody said is Material's default, and smooth. Textures are left out.
  Material material() const;
  bool operator==(const SurfaceChange&) const = default;
};

}  // namespace hl
