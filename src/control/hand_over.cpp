#include "control/hand_over.h"

#include <algorithm>
#include <cmath>

namespace hl {

namespace {

double energy_J(double spring_N_m, const SpringEnd& end, const Vec3& finger_D) {
  return springEnergy_J(spring_N_m, end.stiffness, (end.proxy_D - finger_D).squaredNorm());
}

}  // namespace

void handOver(HandOverState& state, LedgerMode mode, double spring_N_m, const SpringEnd& wanted, double paid_J,
              const Vec3& open_D, const Vec3& finger_D) {
  const bool was_pulling = state.pulling;
  const SpringEnd from = was_pulling ? state.end : SpringEnd{open_D, wanted.stiffness};
  state.pulling = true;
  state.end = wanted;
  if (from.proxy_D == wanted.proxy_D && from.stiffness == wanted.stiffness) return;
  const double start_J = energy_J(spring_N_m, from, finger_D);
  const double budget_J = std::max(0.0, paid_J) + state.ledger.budget_J(mode);
  const double per_square = 0.5 * spring_N_m * from.stiffness;
  if (std::isfinite(budget_J) && per_square > 0) {
    const Vec3 way = wanted.proxy_D - from.proxy_D;
    const double part = partWithin(from.proxy_D - finger_D, way, budget_J / per_square);
    if (part < 1) state.end.proxy_D = from.proxy_D + part * way;
  }
  const double wanted_J = energy_J(spring_N_m, state.end, finger_D);
  if (wanted_J > start_J + budget_J) state.end.stiffness *= (start_J + budget_J) / wanted_J;
  const double change_J = energy_J(spring_N_m, state.end, finger_D) - start_J;
  const double late_J = change_J > 0 ? std::max(0.0, change_J - std::max(0.0, paid_J)) : change_J;
  state.ledger.add(EnergyCause::kLate, std::max(0.0, late_J));
  state.ledger.book(late_J, was_pulling);
}

void refillFromFriction(HandOverState& state, double friction_N, const Vec3& before_D, const Vec3& finger_D) {
  state.ledger.refill(friction_N * (finger_D - before_D).norm());
}

}  // namespace hl
