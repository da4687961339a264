#include "proxy/resistance.h"

#include <algorithm>
#include <cmath>

namespace hl {

Roughness Roughness::of(const Surface& surface) {
  return {surface.read(Quantity::kStaticFriction), surface.read(Quantity::kDynamicFriction),
          surface.read(Quantity::kViscosity), surface.plain(Quantity::kStribeck), surface.plain(Quantity::kPresliding)};
}

void Resistance::add(const Roughness& roughness, const Patch& patch, const Vec2& moved, double normal_m) {
  Rubbing rubbing;
  rubbing.roughness = &roughness;
  rubbing.patch = &patch;
  rubbing.moved = moved;
  rubbing.normal_m = std::max(0.0, normal_m);
  const bool textured = roughness.textured();
  rubbing.stribeck_m = textured ? 0 : roughness.stribeck_m_s * settings_.period_s * settings_.world_per_device;
  rubbing.texcoord = textured ? patch.texcoord(moved) : Vec2(Vec2::Zero());
  rubbing.texcoord_way = Vec2::Zero();
  rubbings_.push(rubbing);
  slip_textured_ |= roughness.slipTextured();
  creep_ += roughness.presliding_N_m / settings_.spring_N_m;
}

Drag Resistance::here() const {
  Drag drag;
  drag.creep = creep_;
  double viscosity_Ns_m = 0;
  for (const Rubbing& rubbing : rubbings_) {
    const Roughness& rough = *rubbing.roughness;
    const double dynamic = std::max(0.0, rough.dynamic.at(rubbing.texcoord));
    const double fixed = std::max(dynamic, rough.fixed.at(rubbing.texcoord));
    drag.rubs.push({fixed * rubbing.normal_m, dynamic * rubbing.normal_m, rubbing.stribeck_m});
    viscosity_Ns_m += std::max(0.0, rough.viscosity.at(rubbing.texcoord));
  }
  drag.viscous = viscosity_Ns_m / (settings_.spring_N_m * settings_.period_s);
  return drag;
}

DragAlong Resistance::at(double part) const {
  DragAlong drag;
  for (const Rubbing& rubbing : rubbings_) {
    const Vec2 texcoord = rubbing.texcoord + part * rubbing.texcoord_way;
    drag.rubbing_m += std::max(0.0, rubbing.roughness->dynamic.at(texcoord)) * rubbing.normal_m;
    drag.viscous += std::max(0.0, rubbing.roughness->viscosity.at(texcoord));
  }
  drag.viscous /= settings_.spring_N_m * settings_.period_s;
  return drag;
}

void Resistance::setWay(const Vec3& way) {
  for (Rubbing& rubbing : rubbings_) {
    if (!rubbing.roughness->slipTextured()) continue;
    const Vec2 over = rubbing.patch->weightsOver(way);
    rubbing.texcoord_way = rubbing.patch->texcoordOver(over);
    countTexels(rubbing);
    findEdge(rubbing.patch->place(rubbing.moved), over);
  }
}

void Resistance::countTexels(const Rubbing& rubbing) {
  for (const Texture* texture : {rubbing.roughness->dynamic.texture, rubbing.roughness->viscosity.texture}) {
    if (!texture) continue;
    const double across = std::abs(rubbing.texcoord_way.x()) * static_cast<double>(texture->width);
    const double up = std::abs(rubbing.texcoord_way.y()) * static_cast<double>(texture->height);
    texels_ = std::max(texels_, across + up);
  }
}

void Resistance::findEdge(const SurfacePlace& from, const Vec2& way) {
  const auto& now = from.weights;
  if (!(now[0] > 0 && now[1] > 0 && now[2] > 0)) return;  // on an edge already
  const std::array<double, 3> change{-way.x() - way.y(), way.x(), way.y()};
  for (std::size_t k = 0; k < 3; ++k) {
    if (now[k] + change[k] < 0) within_ = std::min(within_, -now[k] / change[k]);
  }
}

}  // namespace hl
