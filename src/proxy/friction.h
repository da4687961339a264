// Friction: how far the proxy slips along the surface in one tick. Forces are written as lengths, newtons divided by
// the spring's K, here that which is felt, K s: the pull is the tangential part of finger - proxy; the normal force of
// contact i is its multiplier lambda_i.
//
// Implicit step (Kikuuwe et al. 2006 with B = 0; friction cone of Harwin and Melder): after a slip of D the remaining
// pull balances the resistance,
//   pull - D = sum mu_i lambda_i + (b / K T) D.
// The explicit bound of the paper's equation (3), (f_t - mu f_n) / b, overshoots for b < K T and gives a saw-tooth
// force. The implicit step has the mean force mu f_n + b u without ripple, for every b >= 0 and every speed u.
#pragma once

#include "base/fixed_vector.h"
#include "base/function_ref.h"
#include "proxy/solver.h"

namespace hl {

/// Friction of one contact, m (newtons over K s).
struct ContactFriction {
  double static_m = 0;    ///< mu_s lambda
  double dynamic_m = 0;   ///< mu_d lambda, at most static_m
  double stribeck_m = 0;  ///< slip in one tick at the Stribeck speed; 0: dynamic friction from the first slip on
};

/// Resistance of all contacts to a slip in one direction.
struct SlipResistance {
  FixedVector<ContactFriction, kMaxActive> contacts;
  double viscous = 0;  ///< sum of b / (K T): pull in m per m of slip in one tick
  double presliding_ratio =
      0;  ///< sum of sigma_0 / K of the pre-sliding springs: pull in m per m of pre-sliding offset; 0: rigid

  /// The largest pull, m, that is held without a slip.
  double staticPull() const;
  /// The resistance without its viscous part, m, for a slip of `slip` metres in this tick.
  double coulombPull(double slip) const;
};

/// Resistance at one point of a slip along which it changes, without the Stribeck curve.
struct SlidingResistance {
  double coulomb_m = 0;  ///< sum of mu_d lambda
  double viscous = 0;    ///< as SlipResistance::viscous
};

/// The slip so far in this tick.
struct Slip {
  double length = 0;     ///< m
  double viscous_m = 0;  ///< the pull used up by viscosity: integral of SlipResistance::viscous over the length
};

/// The further slip, m, under a pull of `pull` metres; 0 if the resistance holds the pull. RT-safe.
double slipLength(const SlipResistance& drag, double pull, const Slip& before);

/// As slipLength(), for a resistance that changes along the way. `drag_at` returns the resistance at a distance (m)
/// from the start. It is sampled `samples` times over the pull. The slip ends at the first sample interval in which the
/// resistance holds the proxy, so no narrow line of friction is missed. `viscous` is set to its mean over the slip.
/// RT-safe.
double slipLengthAlong(FunctionRef<SlidingResistance(double)> drag_at, double pull, const Slip& before, int samples,
                       double& viscous);

}  // namespace hl
