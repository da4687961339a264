#include "proxy/energy_booking.h"

#include <algorithm>
#include <cmath>

#include "proxy/spring_energy.h"

namespace hl {

namespace {

void bookCauses(Ledger& ledger, const EnergyBooking::Causes& causes, double moved_J, double stiffened_J) {
  if (moved_J > 0 && causes.shading + causes.bump == 0) {
    ledger.add(EnergyCause::kStiffness, moved_J);  // rounding
  } else if (moved_J > 0) {
    const double bends = causes.shading + causes.bump;
    const double bump = causes.bump / bends;
    ledger.add(EnergyCause::kShading, (1 - bump) * moved_J);
    ledger.add(EnergyCause::kTexture, bump * moved_J);
  }
  if (stiffened_J > 0)
    ledger.add(causes.stiffness_textured ? EnergyCause::kTexture : EnergyCause::kStiffness, stiffened_J);
}

}  // namespace

EnergyBooking::EnergyBooking(const ProxyState& state, const ProxySettings& settings, const Vec3& finger)
    : settings_(settings),
      finger_(finger),
      was_touching_(state.touching),
      stiffness_before_(state.stiffness),
      proxy_before_(state.position),
      presliding_before_J_(state.sticking.springs.energy_J(settings.world_per_device)),
      budget_J_(state.ledger.budget_J(settings.ledger)) {}

double EnergyBooking::energy_J(double stiffness, double distance_squared) const {
  const double scale = settings_.world_per_device;
  return springEnergy_J(settings_.spring_N_m, stiffness, distance_squared / (scale * scale));
}

// Energy change, J, by the proxy's motion since the tick began: 1/2 K s (|e+|^2 - |e-|^2). It is computed from the
// difference of the two positions, so that it is accurate however far the finger is.
double EnergyBooking::moved_J(const Vec3& proxy, double stiffness) const {
  const Vec3 apart = proxy - proxy_before_;
  return energy_J(stiffness, apart.dot((proxy - finger_) + (proxy_before_ - finger_)));
}

// Along the step |proxy - finger|^2 falls up to the nearest point and rises beyond it. The rise is paid for in full. If
// the fall before it were credited, the proxy could jump to its mirror image beyond the finger, and back in the next
// tick.
double EnergyBooking::affordable(const Vec3& proxy, const Vec3& step, double released_J) const {
  const double joule_per_square = energy_J(was_touching_ ? stiffness_before_ : 1, 1);
  if (!(joule_per_square > 0) || !std::isfinite(budget_J_)) return 1;
  const Vec3 e = proxy - finger_;
  const double a = step.squaredNorm();
  if (!(a > 0)) return 1;
  const double nearest = std::clamp(-step.dot(e) / a, 0.0, 1.0);
  const Vec3 at_nearest = e + nearest * step;
  const double spent = moved_J(proxy + nearest * step, 1) / energy_J(1, 1);
  const double budget = (budget_J_ + released_J) / joule_per_square;
  // Earlier steps of the tick may have spent some of it.
  const double left = std::min(budget, budget - spent);
  return std::min(1.0, nearest + partWithin(at_nearest, step, std::max(0.0, left)));
}

Vec3 EnergyBooking::afford(const Vec3& proxy, const Vec3& step, double released_J) {
  const double part = affordable(proxy, step, released_J);
  spent_ = part < 1;
  return part * step;
}

double EnergyBooking::wantedStiffness(TickEnd end, const MeanStiffness& surfaces) const {
  if (end == TickEnd::kOpen) return 1;
  if (end == TickEnd::kOnItsWay && surfaces.empty()) return was_touching_ ? stiffness_before_ : 0;
  return surfaces.value();
}

void EnergyBooking::close(ProxyState& state, TickEnd end, const MeanStiffness& surfaces, const Causes& causes,
                          TickReport& report) const {
  const Vec3 whole = state.position - finger_;
  const double distance_squared = whole.squaredNorm();
  const bool touching = end != TickEnd::kOpen && (was_touching_ || !surfaces.empty());
  double stiffness = wantedStiffness(end, surfaces);
  const double before = was_touching_ ? stiffness_before_ : stiffness;
  const double per_stiffness_J = energy_J(1, distance_squared);
  if (end != TickEnd::kContact) {
    state.sticking.since_slip_s = accuracy::kStuck_s;
    state.sticking.springs = {};
  }
  const double presliding_J = state.sticking.springs.energy_J(settings_.world_per_device);
  const double move_J = moved_J(state.position, before) + presliding_J - presliding_before_J_;
  const double most_J = end == TickEnd::kOnItsWay ? 0 : budget_J_;
  if (move_J + (stiffness - before) * per_stiffness_J > most_J)
    stiffness = std::max(0.0, before + (most_J - move_J) / per_stiffness_J);
  report.target = stiffness == 1 ? state.position : Vec3(finger_ + stiffness * whole);
  const double stiffened_J = (stiffness - before) * per_stiffness_J;
  report.injected_J = move_J + stiffened_J;
  bookCauses(state.ledger, causes, move_J, stiffened_J);
  state.ledger.book(report.injected_J, was_touching_ && touching);
  state.touching = touching;
  state.stiffness = touching ? stiffness : 1;
}

}  // namespace hl
