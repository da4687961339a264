#include "proxy/friction.h"

#include <algorithm>
#include <cmath>

#include "base/plain_math.h"
#include "proxy/tolerances.h"

namespace hl {

double SlipResistance::staticPull() const {
  double sum = 0;
  for (const ContactFriction& rub : contacts) sum += rub.static_m;
  return sum;
}

// mu(v) = mu_d + (mu_s - mu_d) exp(-(v / v_s)^2): the Stribeck curve.
double SlipResistance::coulombPull(double slip) const {
  double sum = 0;
  for (const ContactFriction& rub : contacts) {
    const double ratio = rub.stribeck_m > 0 ? slip / rub.stribeck_m : 1;
    const double left = rub.stribeck_m > 0 ? plain::expOfNegative(-ratio * ratio) : 0;
    sum += rub.dynamic_m + left * (rub.static_m - rub.dynamic_m);
  }
  return sum;
}

// The resistance falls with the slip (Stribeck), so several slips may balance it: the largest is the one in which a
// sliding proxy goes on sliding. From above, the iteration comes down to it.
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

// A place on the way of a slip.
struct Place {
  double at;    // metres from its start
  double left;  // of the pull; negative: held before it
  double used;  // by viscosity up to there
};

// The way of a slip whose drag changes: how far the resistance is from holding the proxy at a place.
struct Balance {
  FunctionRef<SlidingResistance(double)> drag_at;
  double pull;
  double before_m;  // used up by viscosity before this slip

  // `reached`: the last sample at which the proxy still slipped.
  Place place(double at, const Place& reached) const {
    const SlidingResistance drag = drag_at(at);
    const double used = reached.used + drag.viscous * (at - reached.at);
    return {at, pull - at - drag.coulomb_m - before_m - used, used};
  }
};

// Where, between the last sample that slips and `there` that does not, the proxy comes to rest. Where the drag does not
// change the balance is linear and the first guess is it; halving finds a jump of the drag, and the proxy goes just
// over it, onto the line that holds it.
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
