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
  inherit(result.stiffness, caller.stiffness);
  inherit(result.static_friction, caller.static_friction);
  inherit(result.dynamic_friction, caller.dynamic_friction);
  inherit(result.viscosity_Ns_m, caller.viscosity_Ns_m);
  inherit(result.stribeck_m_s, caller.stribeck_m_s);
  inherit(result.presliding_N_m, caller.presliding_N_m);
  inherit(result.smooth, caller.smooth);
  if (untextured) return result;
  for (std::size_t i = 0; i < kQuantities; ++i) inherit(result.textures[i], caller.textures[i]);
  return result;
}

Material SurfaceChange::material() const {
  Material m;
  m.stiffness = stiffness.value_or(m.stiffness);
  m.static_friction = static_friction.value_or(m.static_friction);
  m.dynamic_friction = dynamic_friction.value_or(m.dynamic_friction);
  m.viscosity_Ns_m = viscosity_Ns_m.value_or(m.viscosity_Ns_m);
  m.stribeck_m_s = stribeck_m_s.value_or(m.stribeck_m_s);
  m.presliding_N_m = presliding_N_m.value_or(m.presliding_N_m);
  m.smooth = smooth.value_or(true);
  return m;
}

}  // namespace hl
