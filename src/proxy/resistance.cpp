#include "proxy/resistance.h"

#include <algorithm>
#include <cmath>

namespace hl {

void Resistance::add(const SurfacePlace& place, double normal_m) {
  Rubbing rubbing;
  rubbing.place = &place;
  rubbing.normal_m = std::max(0.0, normal_m);
  rubbing.fixed = reader_.read(Quantity::kStaticFriction, place.primitive);
  rubbing.dynamic = reader_.read(Quantity::kDynamicFriction, place.primitive);
  rubbing.viscosity = reader_.read(Quantity::kViscosity, place.primitive);
  rubbing.textured = rubbing.fixed.texture || rubbing.dynamic.texture || rubbing.viscosity.texture;
  rubbing.stribeck_m =
      rubbing.textured ? 0 : reader_.stribeck_m_s(place.primitive) * settings_.period_s * settings_.world_per_device;
  rubbing.texcoord = rubbing.textured ? reader_.texcoord(place) : Vec2(Vec2::Zero());
  rubbing.texcoord_way = Vec2::Zero();
  rubbings_.push(rubbing);
  textured_ |= rubbing.textured;
  creep_ += reader_.presliding_N_m(place.primitive) / settings_.spring_N_m;
}

Drag Resistance::at(double part) const {
  Drag drag;
  drag.creep = creep_;
  double viscosity_Ns_m = 0;
  for (const Rubbing& rubbing : rubbings_) {
    const Vec2 texcoord = rubbing.texcoord + part * rubbing.texcoord_way;
    const double dynamic = std::max(0.0, rubbing.dynamic.at(texcoord));
    const double fixed = std::max(dynamic, rubbing.fixed.at(texcoord));
    drag.rubs.push({fixed * rubbing.normal_m, dynamic * rubbing.normal_m, rubbing.stribeck_m});
    viscosity_Ns_m += std::max(0.0, rubbing.viscosity.at(texcoord));
  }
  drag.viscous = viscosity_Ns_m / (settings_.spring_N_m * settings_.period_s);
  return drag;
}

void Resistance::setWay(const Vec3& way) {
  for (Rubbing& rubbing : rubbings_) {
    if (!rubbing.textured) continue;
    const SurfacePlace end = reader_.moved(*rubbing.place, way);
    rubbing.texcoord_way = reader_.texcoord(end) - rubbing.texcoord;
    countTexels(rubbing);
    findEdge(*rubbing.place, end);
  }
}

void Resistance::countTexels(const Rubbing& rubbing) {
  for (const Texture* texture : {rubbing.fixed.texture, rubbing.dynamic.texture, rubbing.viscosity.texture}) {
    if (!texture) continue;
    const double across = std::abs(rubbing.texcoord_way.x()) * static_cast<double>(texture->width);
    const double up = std::abs(rubbing.texcoord_way.y()) * static_cast<double>(texture->height);
    texels_ = std::max(texels_, across + up);
  }
}

void Resistance::findEdge(const SurfacePlace& from, const SurfacePlace& to) {
  const auto& now = from.weights;
  if (std::any_of(now.begin(), now.end(), [](double w) { return w <= 0; })) return;  // on an edge already
  for (std::size_t k = 0; k < 3; ++k) {
    if (to.weights[k] < 0) within_ = std::min(within_, now[k] / (now[k] - to.weights[k]));
  }
}

}  // namespace hl
