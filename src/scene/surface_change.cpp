#include "scene/surface_change.h"

namespace hl {

namespace {

template <typename T>
void inherit(std::optional<T>& own, const std::optional<T>& callers) {
  if (!own) own = callers;
}

}  // namespace

SurfaceChange SurfaceChange::over(const SurfaceChange& caller) const {
  SurfaceChange result = *this;
  for (const auto number : kSaidNumbers<SurfaceChange>) inherit(result.*number, caller.*number);
  inherit(result.smooth, caller.smooth);
  if (untextured) return result;
  for (std::size_t i = 0; i < kQuantities; ++i) inherit(result.textures[i], caller.textures[i]);
  return result;
}

Material SurfaceChange::material() const {
  Material m;
  for (std::size_t i = 0; i < kNumbers; ++i) {
    if (const auto& said = this->*kSaidNumbers<SurfaceChange>[i]) m.*kMaterialNumbers[i] = *said;
  }
  m.smooth = smooth.value_or(true);
  return m;
}

}  // namespace hl
