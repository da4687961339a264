// FrictionOnWay: friction and viscosity of all contacts along one straight slip. The surface properties are read once
// for the whole slip, as the texture coordinates are linear along it.
#pragma once

#include <limits>

#include "base/fixed_vector.h"
#include "proxy/friction.h"
#include "proxy/patch.h"
#include "proxy/proxy_state.h"
#include "proxy/solver.h"
#include "proxy/surface.h"

namespace hl {

/// Friction properties of a surface, read once for all points on it.
struct SurfaceFriction {
  SurfaceValue fixed, dynamic, viscosity;  ///< mu_s, mu_d, b in N s/m
  double stribeck_m_s = 0, presliding_N_m = 0;

  static SurfaceFriction of(const Surface& surface);
  bool textured() const { return fixed.texture || slipTextured(); }
  /// Whether the resistance changes along a slip. Static friction does not count: it only decides when a slip begins.
  bool slipTextured() const { return dynamic.texture || viscosity.texture; }
  /// Whether there is friction or viscosity anywhere on the surface.
  bool acts() const { return textured() || fixed.low > 0 || dynamic.low > 0 || viscosity.low > 0; }
};

/// RT-safe. The objects passed to add() must outlive this object.
class FrictionOnWay {
 public:
  /// `felt_N_m`: the spring as it is felt, K s. The resistances in N s/m and N/m act on the hand, however soft it is.
  FrictionOnWay(const ProxySettings& settings, double felt_N_m) : settings_(settings), felt_N_m_(felt_N_m) {}

  /// Adds a contact at the point of `patch` after a change of weights `moved`, with a normal force of `normal_m`
  /// (newtons over K s). `mobility_m_Ns`: by how much faster the surface goes, m/s at the hand, when it is dragged with
  /// 1 N for a tick.
  void add(const SurfaceFriction& friction, const Patch& patch, const Vec2& moved, double normal_m,
           double mobility_m_Ns);

  SlipResistance here() const;
  bool slipTextured() const { return slip_textured_; }

  /// Sets the vector of the slip. Before this call texture coordinates are constant along the way.
  void setWay(const Vec3& way);
  /// Resistance to a sliding proxy at a fraction `part` (0..1) of the way.
  SlidingResistance at(double part) const;
  /// Number of texels that the way crosses, in the finest texture.
  double texels() const { return texels_; }
  /// Fraction of the way at which it leaves a textured triangle. Beyond it the texture is not valid.
  double within() const { return within_; }

 private:
  struct TouchedSurface {
    const SurfaceFriction* friction;
    const Patch* patch;
    Vec2 moved;
    double normal_m, stribeck_m;
    double swing_m_Ns;  // 4 w / p: the inverse of the largest damper that swings no body
    double viscosity_Ns_m(const Vec2& at) const;
    Vec2 texcoord, texcoord_way;
  };
  void countTexels(const TouchedSurface& surface);
  void findEdge(const SurfacePoint& from, const Vec2& way);

  const ProxySettings& settings_;
  double felt_N_m_;
  FixedVector<TouchedSurface, kMaxActive> surfaces_;
  double presliding_ratio_ = 0;
  bool slip_textured_ = false;
  double texels_ = 0;
  double within_ = std::numeric_limits<double>::infinity();
};

}  // namespace hl
