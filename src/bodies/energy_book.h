// Energy book: what changed the energy of a world, step by step. For each step
//
//   change of (kinetic + gravity + spring) = by_hand_J + by_client_J - contact_J - friction_J - joint_J() + solver_J
//
// holds to rounding, spring the energy of the joints' springs and tables. Where impulses P act at once on points that
// move at v before and v' after, the kinetic energy changes by the sum of P (v + v') / 2; so each row's part is exact.
#pragma once

namespace hl {

/// Joules, sums over all steps.
struct EnergyBook {
  double by_hand_J = 0;    ///< work of the hands' contacts on bodies
  double by_client_J = 0;  ///< what clients did to bodies, and work of the scenery that they move
  double contact_J = 0;    ///< lost at contacts of bodies, along the normals
  double friction_J = 0;   ///< lost by friction there
  double joint_damping_J = 0, joint_friction_J = 0, joint_limit_J = 0;  ///< lost at joints
  double solver_J = 0;  ///< added by the finite step: gravity while in contact, turns, joints, correction of positions

  double joint_J() const { return joint_damping_J + joint_friction_J + joint_limit_J; }
  /// The change of energy that all this makes.
  double change_J() const { return by_hand_J + by_client_J - contact_J - friction_J - joint_J() + solver_J; }
};

}  // namespace hl
