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

double slipLengthAlong(FunctionRef<Drag(double)> drag_at, double pull, const Slip& before, int samples,
                       double& viscous) {
  constexpr int kHalvings = 14;
  double reached = 0;
  double used = 0;  // by viscosity on the way
  viscous = 0;
  const auto holds = [&](double at, double& used_there) {
    const Drag drag = drag_at(at);
    used_there = used + drag.viscous * (at - reached);
    return pull - at <= drag.rubbing(at) + before.viscous_m + used_there;
  };
  for (int i = 0; i <= samples; ++i) {
    double there = pull * i / samples;
    double used_there = 0;
    if (holds(there, used_there)) {
      double here = reached;
      for (int k = 0; k < kHalvings && i > 0; ++k) {
        double used_between = 0;
        const double between = 0.5 * (here + there);
        (holds(between, used_between) ? there : here) = between;
      }
      holds(there, used);
      reached = there;
      break;
    }
    reached = there;
    used = used_there;
  }
  viscous = reached > 0 ? used / reached : 0;
  return reached;
}

}  // namespace hl
