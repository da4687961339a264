#include "proxy/friction_on_way.h"

#include <algorithm>
#include <cmath>

namespace hl {

SurfaceFriction SurfaceFriction::of(const Surface& surface) {
  return {surface.read(Quantity::kStaticFriction), surface.read(Quantity::kDynamicFriction),
          surface.read(Quantity::kViscosity), surface.plain(Quantity::kStribeck), surface.plain(Quantity::kPresliding)};
}

// A body that is dragged gets the impulse o that it is owed in the steps after the tick, p = 1 / (1 + K T w) of it in
// each (BodyStepper::addHand). With the velocity u of the finger, v of the surface and w, its mobility, F = B (u - v)
// gives
//   v' = v + w p o,   o' = (1 - p) o + F.
// Its roots are real, so that nothing swings, where 4 B w <= p; a damper B = b drives light bodies apart. So
//   B = b / (1 + 4 b w / p)
double FrictionOnWay::TouchedSurface::viscosity_Ns_m(const Vec2& at) const {
  const double damping_Ns_m = std::max(0.0, friction->viscosity.at(at));
  return damping_Ns_m / (1 + damping_Ns_m * swing_m_Ns);
}

void FrictionOnWay::add(const SurfaceFriction& friction, const Patch& patch, const Vec2& moved, double normal_m,
                        double mobility_m_Ns) {
  TouchedSurface surface;
  surface.friction = &friction;
  surface.patch = &patch;
  surface.moved = moved;
  surface.normal_m = std::max(0.0, normal_m);
  surface.swing_m_Ns = 4 * mobility_m_Ns * (1 + felt_N_m_ * settings_.period_s * mobility_m_Ns);
  const bool textured = friction.textured();
  surface.stribeck_m = textured ? 0 : friction.stribeck_m_s * settings_.period_s * settings_.world_per_device;
  surface.texcoord = textured ? patch.texcoord(moved) : Vec2(Vec2::Zero());
  surface.texcoord_way = Vec2::Zero();
  surfaces_.push(surface);
  slip_textured_ |= friction.slipTextured();
  const double spring_N_m = friction.presliding_N_m;
  presliding_ratio_ += spring_N_m / (1 + spring_N_m * settings_.period_s * surface.swing_m_Ns) / felt_N_m_;
}

SlipResistance FrictionOnWay::here() const {
  SlipResistance drag;
  drag.presliding_ratio = presliding_ratio_;
  double viscosity_Ns_m = 0;
  for (const TouchedSurface& surface : surfaces_) {
    const SurfaceFriction& rough = *surface.friction;
    const double dynamic = std::max(0.0, rough.dynamic.at(surface.texcoord));
    const double fixed = std::max(dynamic, rough.fixed.at(surface.texcoord));
    drag.contacts.push({fixed * surface.normal_m, dynamic * surface.normal_m, surface.stribeck_m});
    viscosity_Ns_m += surface.viscosity_Ns_m(surface.texcoord);
  }
  drag.viscous = viscosity_Ns_m / (felt_N_m_ * settings_.period_s);
  return drag;
}

SlidingResistance FrictionOnWay::at(double part) const {
  SlidingResistance drag;
  for (const TouchedSurface& surface : surfaces_) {
    const Vec2 texcoord = surface.texcoord + part * surface.texcoord_way;
    drag.coulomb_m += std::max(0.0, surface.friction->dynamic.at(texcoord)) * surface.normal_m;
    drag.viscous += surface.viscosity_Ns_m(texcoord);
  }
  drag.viscous /= felt_N_m_ * settings_.period_s;
  return drag;
}

void FrictionOnWay::setWay(const Vec3& way) {
  for (TouchedSurface& surface : surfaces_) {
    if (!surface.friction->slipTextured()) continue;
    const Vec2 over = surface.patch->weightsOver(way);
    surface.texcoord_way = surface.patch->texcoordOver(over);
    countTexels(surface);
    findEdge(surface.patch->place(surface.moved), over);
  }
}

void FrictionOnWay::countTexels(const TouchedSurface& surface) {
  for (const Texture* texture : {surface.friction->dynamic.texture, surface.friction->viscosity.texture}) {
    if (!texture) continue;
    const double across = std::abs(surface.texcoord_way.x()) * static_cast<double>(texture->width);
    const double up = std::abs(surface.texcoord_way.y()) * static_cast<double>(texture->height);
    texels_ = std::max(texels_, across + up);
  }
}

void FrictionOnWay::findEdge(const SurfacePoint& from, const Vec2& way) {
  const auto& now = from.weights;
  if (!(now[0] > 0 && now[1] > 0 && now[2] > 0)) return;  // the point is already on an edge
  const std::array<double, 3> change{-way.x() - way.y(), way.x(), way.y()};
  for (std::size_t k = 0; k < 3; ++k) {
    if (now[k] + change[k] < 0) within_ = std::min(within_, -now[k] / change[k]);
  }
}

}  // namespace hl
