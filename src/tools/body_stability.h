// How stiff the servo's spring may be where a device presses on a body that is free to move: found by what a session
// runs, and beside it the couplings of a device and an engine that takes the hand's force as a force from outside.
//
// A device of mass m_d and damping b_d, a body of mass m, a spring K between, a step T. The body is moved by the force
// K (e + theta T v), e the stretch at the begin of the step, v the body's velocity at its end, so many steps late. To
// the first order in T it is stable where
//
//   b_d >= K T (1 + rho) (1/2 + d_dev + rho (d_body - theta)),   rho = m_d / m,
//
// d_dev and d_body whole steps of delay toward device and body. rho = 0 is the wall. HL's own is theta = 1.
#pragma once

namespace hl {

/// A body that rests on a device without hand and friction.
struct BodyOnDevice {
  double body_kg = 0.1;
  double device_kg = 0.075;
  double damping_Ns_m = 0.5;  ///< of the device
  double rate_Hz = 1000;
  int delay_steps = 0;  ///< d_dev, 0..15
};

struct Coupling {
  double theta = 1;         ///< 0..1: how much of the body's answer the force knows of
  int body_late_steps = 0;  ///< d_body, 0 or 1
};
inline constexpr Coupling kOneSolve{1, 0};      ///< HL's
inline constexpr Coupling kForceBefore{0, 0};   ///< the force of the begin of the step
inline constexpr Coupling kForceOneLate{0, 1};  ///< that of the step before: an engine beside the servo

/// Both of the inequality above. The stiffness is infinite, and the damping 0, where it holds for any.
double leastDamping_Ns_m(const BodyOnDevice& on, const Coupling& coupling, double stiffness_N_m);
double mostStiffness_N_m(const BodyOnDevice& on, const Coupling& coupling);

/// Whether a small swing grows between device and body, as two masses on a spring, step by step.
bool swingGrows(const BodyOnDevice& on, const Coupling& coupling, double stiffness_N_m);
/// The same in a session.
bool swingGrows(const BodyOnDevice& on, double stiffness_N_m);

inline constexpr double kBodyStiffnessLow_N_m = 0.01, kBodyStiffnessHigh_N_m = 40'000;
/// The highest stiffness at which no swing grows, to 0.5 %; kBodyStiffnessHigh_N_m where none does.
double highestStiffnessOnBody_N_m(const BodyOnDevice& on, const Coupling& coupling);
/// The same in a session; not looked for below what is stable at a wall.
double highestStiffnessOnBody_N_m(const BodyOnDevice& on);

}  // namespace hl
