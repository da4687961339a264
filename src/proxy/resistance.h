// Resistance: what friction and viscosity of the contacts do to a slip along one straight way. The surfaces are read
// once for all places on the way: along it the texture coordinates are linear.
#pragma once

#include <limits>

#include "base/fixed_vector.h"
#include "proxy/friction.h"
#include "proxy/proxy.h"
#include "proxy/surface.h"

namespace hl {

/// RT-safe. The places and the reader must outlive it.
class Resistance {
 public:
  Resistance(const SurfaceReader& reader, const ProxySettings& settings) : reader_(reader), settings_(settings) {}

  /// One more contact, touched at `place`, with a normal force of `normal_m`.
  void add(const SurfacePlace& place, double normal_m);

  /// Here, or at a part 0..1 of the way.
  Drag at(double part = 0) const;
  bool textured() const { return textured_; }

  /// Where the slip goes. Until now there is no way: everywhere is here.
  void setWay(const Vec3& way);
  /// Texels that the way crosses, in the finest of the textures.
  double texels() const { return texels_; }
  /// The part of the way after which a textured triangle is left behind: beyond, its texture says nothing.
  double within() const { return within_; }

 private:
  struct Rubbing {
    const SurfacePlace* place;
    double normal_m, stribeck_m;
    bool textured;
    SurfaceValue fixed, dynamic, viscosity;
    Vec2 texcoord, texcoord_way;
  };
  void countTexels(const Rubbing& rubbing);
  void findEdge(const SurfacePlace& from, const SurfacePlace& to);

  const SurfaceReader& reader_;
  const ProxySettings& settings_;
  FixedVector<Rubbing, 3> rubbings_;
  double creep_ = 0;
  bool textured_ = false;
  double texels_ = 0;
  double within_ = std::numeric_limits<double>::infinity();
};

}  // namespace hl
