// Friction: how far a proxy slips along the surface in one tick. Forces are written as lengths, newtons over the
// spring's K: the pull is the tangential part of finger - proxy, the normal force of contact i its multiplier lambda_i.
//
// The implicit step (science: Kikuuwe et al. 2006 with B = 0; Harwin & Melder's friction cone): after a slip of D the
// pull that is left balances the resistance,
//   pull - D = sum mu_i lambda_i + (b / K T) D.
// The explicit bound of the paper's equation (3), (f_t - mu f_n) / b, overshoots for b < K T and saw-tooths; this one
// has the mean mu f_n + b u and no ripple, for every b >= 0 and speed u.
#pragma once

#include "base/fixed_vector.h"
#include "base/function_ref.h"

namespace hl {

/// One contact's part in the resistance. Metres: newtons over K.
struct ContactFriction {
  double static_m = 0;    ///< mu_s lambda
  double dynamic_m = 0;   ///< mu_d lambda, at most static_m
  double stribeck_m = 0;  ///< slip in one tick at the Stribeck speed; 0: dynamic as soon as it slips
};

/// What resists a slip: all contacts together, along one direction.
struct SlipResistance {
  FixedVector<ContactFriction, 3> contacts;
  double viscous = 0;  ///< sum of b / (K T): metres of pull for a metre of slip in one tick
  double presliding_ratio =
      0;  ///< sum of sigma_0 / K, the pre-sliding springs: metres of pull for a metre of offset; 0: rigid

  /// The pull that is held without any slip.
  double staticPull() const;
  /// The resistance without its viscous part when the proxy slips `slip` metres in this tick.
  double coulombPull(double slip) const;
};

/// What resists at one place of a way along which it changes, without the Stribeck curve.
struct SlidingResistance {
  double coulomb_m = 0;  ///< sum of mu_d lambda
  double viscous = 0;    ///< as SlipResistance's
};

/// The slip so far in this tick.
struct Slip {
  double length = 0;     ///< m
  double viscous_m = 0;  ///< the pull that viscosity has used up: integral of SlipResistance::viscous over the length
};

/// The further slip under a pull of `pull` metres; 0 when the resistance holds it. RT-safe.
double slipLength(const SlipResistance& drag, double pull, const Slip& before);

/// The same where the drag changes along the way: `drag_at` returns it for a distance from here and is sampled
/// `samples` times over the pull: stops where the resistance first holds the proxy, so no narrow line of friction is
/// missed. `viscous` becomes the mean over the way. RT-safe.
double slipLengthAlong(FunctionRef<SlidingResistance(double)> drag_at, double pull, const Slip& before, int samples,
                       double& viscous);

}  // namespace hl
