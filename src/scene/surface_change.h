// SurfaceChange: the surface properties set by one part of a hierarchy. Properties that are not set are those of the
// caller.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "scene/material.h"

namespace hl {

/// A texture, by its name in the scene.
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
  bool untextured = false;  ///< the textures of the caller are not used

  /// These properties; those not set are taken from `caller`.
  SurfaceChange over(const SurfaceChange& caller) const;
  /// The resulting material; properties that are not set are Material's defaults, but smooth is on. Without textures.
  Material material() const;
  bool operator==(const SurfaceChange&) const = default;
};

}  // namespace hl
