#include "proxy/friction.h"

#include <algorithm>
#include <cmath>

#include "base/plain_math.h"
#include "proxy/tolerances.h"

namespace hl {

double SlipResistance::staticPull() const {
  double sum = 0;
  for (const ContactFriction& contact : contacts) sum += contact.static_m;
  return sum;
}

// mu(v) = mu_d + (mu_s - mu_d) exp(-(v / v_s)^2): the Stribeck curve.
double SlipResistance::coulombPull(double slip) const {
  double sum = 0;
  for (const ContactFriction& contact : contacts) {
    const double ratio = contact.stribeck_m > 0 ? slip / contact.stribeck_m : 1;
    const double left = contact.stribeck_m > 0 ? plain::expOfNegative(-ratio * ratio) : 0;
    sum += contact.dynamic_m + left * (contact.static_m - contact.dynamic_m);
  }
  return sum;
}

// The resistance falls with the slip (Stribeck), so several slips may balance it. The largest is the one at which a
// sliding proxy keeps sliding. The fixed-point iteration starts above it and decreases to it.
double slipLength(const SlipResistance& drag, double pull, const Slip& before) {
  double slip = pull;
  for (int i = 0; i < accuracy::kSlipRounds; ++i) {
    const double next = (pull - drag.coulombPull(before.length + slip) - before.viscous_m) / (1 + drag.viscous);
    if (!(next > 0)) return 0;
    if (next >= slip) break;
    slip = next;
  }
  return slip;
}

namespace {

// A point of a slip.
struct Place {
  double at;    // m from the start of the slip
  double left;  // remaining pull minus resistance, m; negative: the proxy stops before this point
  double used;  // pull used up by viscosity up to this point, m
};

// The balance of pull and resistance along a slip whose resistance changes.
struct Balance {
  FunctionRef<SlidingResistance(double)> drag_at;
  double pull;
  double before_m;  // pull used up by viscosity before this slip, m

  // `reached`: the last sample at which the proxy still slips.
  Place place(double at, const Place& reached) const {
    const SlidingResistance drag = drag_at(at);
    const double used = reached.used + drag.viscous * (at - reached.at);
    return {at, pull - at - drag.coulomb_m - before_m - used, used};
  }
};

// The rest point between the last sample that slips, `reached`, and a sample that does not, `there`. For a constant
// resistance the balance is linear, and the first (secant) guess is exact. Otherwise bisection finds a jump of the
// resistance; the result lies just beyond the jump, on the line that holds the proxy.
Place restBetween(const Balance& balance, const Place& reached, Place there) {
  Place here = reached;
  for (int i = 0; i < accuracy::kRestRounds; ++i) {
    const double guess = here.at + (there.at - here.at) * here.left / (here.left - there.left);
    const Place guessed = balance.place(guess, reached);
    if (std::abs(guessed.left) <= accuracy::kBalanced * balance.pull) return guessed;
    const Place middle = balance.place(0.5 * (here.at + there.at), reached);
    (middle.left > 0 ? here : there) = middle;
  }
  return there;
}

}  // namespace

double slipLengthAlong(FunctionRef<SlidingResistance(double)> drag_at, double pull, const Slip& before, int samples,
                       double& viscous) {
  const Balance balance{drag_at, pull, before.viscous_m};
  Place reached = balance.place(0, {0, 0, 0});
  if (reached.left <= 0) return 0;
  for (int i = 1; i <= samples; ++i) {
    Place there = balance.place(pull * i / samples, reached);
    const bool rests = there.left <= 0;
    if (rests) there = restBetween(balance, reached, there);
    if (there.at > 0) viscous = there.used / there.at;
    if (rests) return there.at;
    reached = there;
  }
  return pull;
}

}  // namespace hl
