// PHANToM Premium 1.5: the published joint-space model of the 3-DoF arm.
// Cavusoglu, Feygin, Tendick, "A Critical Study of the Mechanical and Electrical Properties of the PHANToM Haptic
// Interface", Presence 11(6), 2002: kinematics, mass matrix, masses and inertias; gravity is compensated.
// Phantom frame P: x from the base toward the user at q1 = 0, y to the user's right, z up; joints q in radian.
#pragma once

#include "base/vec.h"

namespace hl {

struct PhantomParameters {
  double l1 = 0.215, l2 = 0.170, l3 = 0.0325;  ///< m
  double ma = 0.0202, mc = 0.0249;             ///< kg
  // NOLINTBEGIN(readability-identifier-naming): the names of the source
  Vec3 Ia{0.4864e-4, 0.001843e-4, 0.4864e-4};  ///< kg m^2, principal
  Vec3 Ic{0.959e-4, 0.959e-4, 0.0051e-4};
  Vec3 Ibe{11.09e-4, 10.06e-4, 0.591e-4};
  Vec3 Idf{7.11e-4, 0.629e-4, 6.246e-4};
  double Ibase_yy = 11.87e-4;
  // NOLINTEND(readability-identifier-naming)
  Vec3 gear{13.3, 11.2, 11.2};     ///< motor turns for one of the joint
  double rotor_inertia = 1.08e-6;  ///< kg m^2, at the motor
  bool with_rotors = true;
  double joint_friction_Nm = 0.01;    ///< Coulomb, each joint
  double joint_damping_Nms = 0.0005;  ///< N m s/rad, each joint
  double motor_torque_peak_Nm = 0.129;
  double motor_torque_continuous_Nm = 0.0286;
  double encoder_counts = 4000;  ///< for one motor turn
  int dac_bits = 16;
  Vec3 q_min{-1.5708, -2.1642, -0.5061};  ///< rad: -90, -124, -29 degrees
  Vec3 q_max{1.5708, 2.0769, 3.7350};     ///< rad: 90, 119, 214 degrees
  double q3_less_q2_min = -1.1345;        ///< rad: -65 degrees, the links fold no further
  double q3_less_q2_max = 0.9599;         ///< rad: 55 degrees
  double stop_stiffness_Nm_rad = 20;      ///< of every end stop
  double stop_damping_Nms_rad = 0.02;
};

/// Tip in frame P.
Vec3 phantomTip(const PhantomParameters& p, const Vec3& q);
/// d tip / d q.
Mat3 phantomJacobian(const PhantomParameters& p, const Vec3& q);
/// Joints that put the tip at x (elbow as in the nominal pose). False when out of reach.
bool phantomJoints(const PhantomParameters& p, const Vec3& x, Vec3& q);
/// M(q), symmetric positive definite.
Mat3 phantomMass(const PhantomParameters& p, const Vec3& q);
/// C(q, qdot) qdot from the Christoffel symbols of M.
Vec3 phantomCoriolis(const PhantomParameters& p, const Vec3& q, const Vec3& qdot);
/// Torque of the end stops, springs with damping; zero inside the limits.
Vec3 phantomStops(const PhantomParameters& p, const Vec3& q, const Vec3& qdot);
/// Energy in the springs of the end stops, J.
double phantomStopEnergy_J(const PhantomParameters& p, const Vec3& q);
/// Joint rates after the friction of one time step: the impulse of each joint is at most friction * dt and opposes its
/// rate; a joint that less would stop stands still. `impulse` is where the solution starts, and returns it.
Vec3 phantomFriction(const PhantomParameters& p, const Mat3& mass, const Vec3& qdot, double dt_s, Vec3& impulse);

}  // namespace hl
