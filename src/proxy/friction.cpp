#include "proxy/friction.h"

#include <algorithm>
#include <cmath>

namespace hl {

double Drag::holding() const {
  double sum = 0;
  for (const Rub& rub : rubs) sum += rub.static_m;
  return sum;
}

// mu(v) = mu_d + (mu_s - mu_d) exp(-(v / v_s)^2): the Stribeck curve.
double Drag::rubbing(double slip) const {
  double sum = 0;
  for (const Rub& rub : rubs) {
    const double ratio = rub.stribeck_m > 0 ? slip / rub.stribeck_m : 1;
    const double left = rub.stribeck_m > 0 ? std::exp(-ratio * ratio) : 0;
    sum += rub.dynamic_m + left * (rub.static_m - rub.dynamic_m);
  }
  return sum;
}

// The resistance falls with the slip (Stribeck), so several slips may balance it: the largest is the one in which a
// sliding proxy goes on sliding. From above, the iteration comes down to it.
double slipLength(const Drag& drag, double pull, const Slip& before) {
  constexpr int kRounds = 60;
  double slip = pull;
  for (int i = 0; i < kRounds; ++i) {
    const double next = (pull - drag.rubbing(before.length + slip) - before.viscous_m) / (1 + drag.viscous);
    if (!(next > 0)) return 0;
    if (next >= slip) break;
    slip = next;
  }
  return slip;
}

namespace {

// The way of a slip whose drag changes: how far the resistance is from holding the proxy at a place.
struct Balance {
  FunctionRef<Drag(double)> drag_at;
  double pull;
  double before_m;     // used up by viscosity before this slip
  double reached = 0;  // the last sample at which the proxy still slipped
  double used = 0;     // by viscosity up to there

  // Metres of pull left over at a place beyond `reached`; negative: held before it.
  double left(double at, double& used_there) const {
    const Drag drag = drag_at(at);
    used_there = used + drag.viscous * (at - reached);
    return pull - at - drag.rubbing(at) - before_m - used_there;
  }
};

// Where, between the last sample that slips and `there` that does not, the proxy comes to rest. Where the drag does not
// change the balance is linear and the first guess is it; halving finds a jump of the drag, and the proxy goes just
// over it, onto the line that holds it.
double restBetween(const Balance& balance, double there, double left_here, double left_there) {
  constexpr int kRounds = 20;
  constexpr double kBalanced = 1e-12;
  double here = balance.reached, used = 0;
  for (int i = 0; i < kRounds; ++i) {
    const double guess = here + (there - here) * left_here / (left_here - left_there);
    const double left_guess = balance.left(guess, used);
    if (std::abs(left_guess) <= kBalanced * balance.pull) return guess;
    const double between = 0.5 * (here + there);
    const double left = balance.left(between, used);
    (left > 0 ? here : there) = between;
    (left > 0 ? left_here : left_there) = left;
  }
  return there;
}

}  // namespace

double slipLengthAlong(FunctionRef<Drag(double)> drag_at, double pull, const Slip& before, int samples,
                       double& viscous) {
  Balance balance{drag_at, pull, before.viscous_m};
  viscous = drag_at(0).viscous;
  double used = 0;
  double left_here = balance.left(0, used);
  if (left_here <= 0) return 0;
  for (int i = 1; i <= samples; ++i) {
    const double there = pull * i / samples;
    const double left_there = balance.left(there, used);
    if (left_there <= 0) {
      const double rest = restBetween(balance, there, left_here, left_there);
      balance.left(rest, used);
      if (rest > 0) viscous = used / rest;
      return rest;
    }
    balance.reached = there;
    balance.used = used;
    left_here = left_there;
  }
  viscous = used / pull;
  return pull;
}

}  // namespace hl
