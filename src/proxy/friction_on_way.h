// FrictionOnWay: what friction and viscosity of the contacts do to a slip along one straight way. The surfaces are read
// once for all places on the way: along it the texture coordinates are linear.
#pragma once

#include <limits>

#include "base/fixed_vector.h"
#include "proxy/friction.h"
#include "proxy/patch.h"
#include "proxy/proxy_state.h"
#include "proxy/surface.h"

namespace hl {

/// What a surface does against a slip, read once for all places on it.
struct SurfaceFriction {
  SurfaceValue fixed, dynamic, viscosity;  ///< mu_s, mu_d, b in N s/m
  double stribeck_m_s = 0, presliding_N_m = 0;

  static SurfaceFriction of(const Surface& surface);
  bool textured() const { return fixed.texture || slipTextured(); }
  /// Whether what resists a slip changes along it; static friction only says when one begins.
  bool slipTextured() const { return dynamic.texture || viscosity.texture; }
  /// Whether there is any, somewhere on the surface.
  bool acts() const { return textured() || fixed.low > 0 || dynamic.low > 0 || viscosity.low > 0; }
};

/// RT-safe. What is added must outlive it.
class FrictionOnWay {
 public:
  explicit FrictionOnWay(const ProxySettings& settings) : settings_(settings) {}

  /// One more contact, touched where the patch has `moved` to, with a normal force of `normal_m`.
  void add(const SurfaceFriction& friction, const Patch& patch, const Vec2& moved, double normal_m);

  SlipResistance here() const;
  bool slipTextured() const { return slip_textured_; }

  /// Where the slip goes. Until now there is no way: everywhere is here.
  void setWay(const Vec3& way);
  /// At a part 0..1 of the way, of a proxy that slides.
  SlidingResistance at(double part) const;
  /// Texels that the way crosses, in the finest of the textures.
  double texels() const { return texels_; }
  /// The part of the way after which a textured triangle is left behind: beyond, its texture says nothing.
  double within() const { return within_; }

 private:
  struct TouchedSurface {
    const SurfaceFriction* friction;
    const Patch* patch;
    Vec2 moved;
    double normal_m, stribeck_m;
    Vec2 texcoord, texcoord_way;
  };
  void countTexels(const TouchedSurface& surface);
  void findEdge(const SurfacePoint& from, const Vec2& way);

  const ProxySettings& settings_;
  FixedVector<TouchedSurface, 3> surfaces_;
  double presliding_ratio_ = 0;
  bool slip_textured_ = false;
  double texels_ = 0;
  double within_ = std::numeric_limits<double>::infinity();
};

}  // namespace hl
